// Entry point of the page of worlds.
import "./world.css";
import { installHandle } from "./test_handle";
import { WorldPage } from "./world_page";

const page = new WorldPage();
installHandle(page);
void page.begin();
