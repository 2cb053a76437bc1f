// Entry point of the designer's page: photographs that are dropped on it, pasted or chosen, and
// the draft of the last visit.
import "./designer.css";
import { acceptDropped } from "../file_drop";
import { Designer } from "./designer";

const designer = new Designer();
void designer.resume();
acceptDropped((file) => void designer.open(file));
addEventListener("paste", (event) => {
    const file = event.clipboardData?.files[0];
    if (!file) return;
    event.preventDefault();
    void designer.open(file);
});
