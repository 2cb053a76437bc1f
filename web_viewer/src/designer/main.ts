// Entry point of the designer's page: photographs that are dropped on it, pasted or chosen, the draft
// of the last visit, and a species of the library that a link names.
import "./designer.css";
import { acceptDropped } from "../file_drop";
import { Designer } from "./designer";
import { sharedIn } from "./library_entry";

const designer = new Designer();
const link = sharedIn(location.hash);
// The key of a link should not stay in the address.
if (link) history.replaceState(null, "", location.pathname + location.search);
void designer.resume().then(() => link && designer.openShared(link));
acceptDropped((file, on) => designer.receive(file, on));
addEventListener("paste", (event) => {
    const file = event.clipboardData?.files[0];
    if (!file) return;
    event.preventDefault();
    designer.receive(file, document.activeElement);
});
