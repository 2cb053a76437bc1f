// Entry point of the page that breeds.
import "./breed.css";
import { tokenIn } from "../designer/library";
import { storageKey } from "../designer/library_panel";
import { Breeder } from "./breeder";
import { installHandle } from "./test_handle";

const token = tokenIn(location.hash);
if (token) sessionStorage.setItem(storageKey, token);
// The address is in the history of the browser; the token should not be.
if (token) history.replaceState(null, "", location.pathname + location.search);

const breeder = new Breeder();
installHandle(breeder);
void breeder.begin();
