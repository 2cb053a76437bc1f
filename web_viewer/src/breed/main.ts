// Entry point of the page that breeds.
import "./breed.css";
import { tokenIn } from "../designer/library";
import { storeToken, takeTokenOfAddress } from "../designer/library_session";
import { Breeder } from "./breeder";
import { installHandle } from "./test_handle";

const token = tokenIn(takeTokenOfAddress() ?? "");
if (token) storeToken(token, false);

const breeder = new Breeder();
installHandle(breeder);
void breeder.begin();
