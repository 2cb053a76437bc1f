// The dialog in which a photograph of the cap, from above or from below, gets its lines.
import { byId, make } from "../dom";
import { History } from "../history";
import { CapMarks, marks, type Mark } from "./cap_marks";
import {
    isComplete,
    mostStrokes,
    nothingDrawn,
    strokeCount,
    strokesOf,
    tools,
    withStrokes,
    type CapSide,
    type CapSketch,
    type Gesture,
    type Tool,
} from "./gesture";
import { PointTable } from "./point_table";
import type { StoredPhoto } from "./service";
import { Sketch } from "./sketch";
import { words, type ToolWords } from "./tool_words";

type CapTool = Tool | Mark;
type CapWords = Readonly<Record<CapTool, ToolWords>>;

const ofBoth: Readonly<Record<Tool, ToolWords>> = {
    axis: {
        label: "Across the cap",
        sentence: "Draw across the cap, from edge to edge",
        title: "The line through the middle of the cap, from edge to edge",
    },
    cap: {
        label: "Second line",
        sentence: "Draw across the cap the other way, if it is not round here",
        title: "A second line from edge to edge, for a cap that is not round on the photograph",
    },
    keep: {
        ...words.keep,
        sentence: "Draw on what might be taken for background",
        title: "A stroke on a part of the cap that looks like what is around it",
    },
    drop: {
        ...words.drop,
        sentence: "Draw on what is no part of the cap",
        title: "A stroke on something that touches the cap or lies on it",
    },
    frame: { ...words.frame, sentence: "Draw a frame around the cap" },
};

const wordsOf: Readonly<Record<CapSide, CapWords>> = {
    above: {
        ...ofBoth,
        centre: {
            label: "Middle",
            sentence: "Click the highest place of the cap, if it is not in the middle",
            title: "The highest place of the cap; without it the middle of the cap",
        },
        stemEnd: { label: "", sentence: "", title: "" },
    },
    below: {
        ...ofBoth,
        centre: {
            label: "Stem",
            sentence: "Click where the stem is fixed to the cap",
            title: "Where the stem is fixed; without it the middle of the cap",
        },
        stemEnd: {
            label: "End of the stem",
            sentence: "Click where the stem ends on the photograph",
            title: "What is between the end of the stem and where it is fixed is hidden by it",
        },
    },
};

const hints: Readonly<Record<CapSide, string>> = {
    above: "All of the cap has to be on the photograph.",
    below: "If the stem hides a part of the lower face, say where it is fixed and where it ends.",
};

export interface OpenedPhoto {
    stored: StoredPhoto;
    /** Address of its picture. */
    address: string;
}

export class CapDialog {
    private readonly dialog = byId<HTMLDialogElement>("cap-dialog");
    private readonly sketch: Sketch;
    private readonly marks: CapMarks;
    private readonly table: PointTable;
    private readonly buttons = new Map<CapTool, HTMLButtonElement>();
    private history = new History<CapSketch>({ gesture: nothingDrawn });
    private side_: CapSide = "above";
    private stored: StoredPhoto | undefined;
    private tool: CapTool | undefined;
    private done: ((drawn: CapSketch | undefined) => void) | undefined;

    /** `another` is called when another photograph is wanted in place of the shown one. */
    constructor(another: (side: CapSide) => void) {
        const { dialog } = this;
        const said = (text: string): void => {
            byId("cap-status").textContent = text;
        };
        this.sketch = new Sketch(
            {
                drawn: (gesture) => this.drawn(gesture),
                pending: () => this.showOrder(),
                pinching: () => this.marks.giveUp(),
                said,
            },
            byId<HTMLElement & SVGSVGElement>("cap-sketch"),
            byId<HTMLOutputElement>("cap-place"),
        );
        this.marks = new CapMarks((place) => this.sketch.exactly(place), {
            moved: (mark, place) => {
                this.change({ [mark]: place });
                this.use(mark);
            },
            said,
        });
        this.sketch.overlay(this.marks.element);
        this.table = new PointTable((gesture) => this.change({ gesture }), byId("cap-points"), "cap-point");
        for (const tool of [...tools, ...marks]) {
            const button = make("button", { type: "button", "data-tool": tool });
            button.addEventListener("click", () => this.use(tool));
            this.buttons.set(tool, button);
            byId("cap-tools").append(button);
        }
        const { sketch } = this;
        const clicks: Readonly<Record<string, () => void>> = {
            "cap-finish": () => sketch.finish(),
            "cap-take-back": () => sketch.takeBack(),
            "cap-clear": () => this.clear(),
            "cap-zoom-in": () => sketch.zoomIn(),
            "cap-zoom-out": () => sketch.zoomOut(),
            "cap-zoom-whole": () => sketch.zoomWhole(),
            "cap-undo": () => this.step("undo"),
            "cap-redo": () => this.step("redo"),
            "cap-another": () => another(this.side_),
            "cap-cancel": () => dialog.close(),
            "cap-use": () => this.close(this.history.value),
        };
        for (const [id, act] of Object.entries(clicks)) byId(id).addEventListener("click", act);
        dialog.addEventListener("close", () => this.close(undefined));
        dialog.addEventListener("keydown", (event) => this.key(event));
    }

    /** The side whose photograph is shown, undefined while the dialog is closed. */
    get side(): CapSide | undefined {
        return this.dialog.open ? this.side_ : undefined;
    }

    /** Shows a photograph; returns what is drawn on it, undefined if it is not to be used. */
    open(
        side: CapSide,
        { stored, address }: OpenedPhoto,
        start: CapSketch,
    ): Promise<CapSketch | undefined> {
        this.done?.(undefined);
        this.side_ = side;
        this.stored = stored;
        this.history.begin(start);
        const text = wordsOf[side];
        for (const [tool, button] of this.buttons) {
            button.textContent = text[tool].label;
            button.title = text[tool].title;
            button.hidden = !text[tool].label;
        }
        byId("cap-title").textContent = `The cap from ${side}`;
        const needed = stored.alpha
            ? "It is cut out already: it needs no line."
            : "One line across the cap is enough.";
        byId("cap-hint").textContent = `${needed} ${hints[side]}`;
        this.say("");
        if (!this.dialog.open) this.dialog.showModal();
        this.tool = undefined;
        this.sketch.open(address, stored);
        this.marks.open(stored, { centre: text.centre.label, stemEnd: text.stemEnd.label });
        this.use("axis");
        this.restored();
        byId("cap-sketch").focus();
        return new Promise((resolve) => (this.done = resolve));
    }

    /** Shows why another photograph cannot be shown. */
    say(text: string): void {
        byId("cap-problem").hidden = text === "";
        byId("cap-problem").textContent = text;
    }

    private close(drawn: CapSketch | undefined): void {
        const { done } = this;
        this.done = undefined;
        this.dialog.close();
        done?.(drawn);
    }

    private drawn(gesture: Gesture): void {
        if (strokeCount(gesture) <= mostStrokes) return this.change({ gesture });
        this.say(`A photograph takes ${mostStrokes} strokes at most; clear some of them first.`);
        this.sketch.gesture = this.history.value.gesture;
    }

    private change(change: Partial<CapSketch>): void {
        this.history.push({ ...this.history.value, ...change });
        this.restored();
    }

    private step(kind: "undo" | "redo"): void {
        if (kind === "undo" && this.sketch.takeBack()) return;
        this.history[kind]();
        this.restored();
        if (this.tool) this.use(this.tool);
    }

    private clear(): void {
        const { tool } = this;
        if (tool === "centre" || tool === "stemEnd") this.change({ [tool]: undefined });
        else if (tool) this.change({ gesture: withStrokes(this.history.value.gesture, tool, []) });
        if (tool) this.use(tool);
    }

    /** Shows what the history is at. */
    private restored(): void {
        const { value } = this.history;
        this.say("");
        this.sketch.gesture = value.gesture;
        this.marks.show(value);
        byId<HTMLButtonElement>("cap-undo").disabled = !this.history.undoable;
        byId<HTMLButtonElement>("cap-redo").disabled = !this.history.redoable;
        byId<HTMLButtonElement>("cap-use").disabled = !isComplete(value, this.stored?.alpha ?? false);
        this.showOrder();
    }

    private use(tool: CapTool): void {
        // A place that is being chosen is given up, which must not change the tool.
        this.tool = undefined;
        this.sketch.pick(undefined);
        this.tool = tool;
        const isMark = tool === "centre" || tool === "stemEnd";
        this.sketch.idle = isMark;
        this.marks.element.classList.toggle("behind", !isMark);
        if (!isMark) this.sketch.tool = tool;
        else if (this.history.value[tool]) this.marks.focus(tool);
        else this.pick(tool);
        this.showOrder();
    }

    /** Lets the next click, or Enter at the crosshair, set a mark. */
    private pick(mark: Mark): void {
        this.sketch.pick((place) => {
            if (this.tool !== mark) return;
            if (!place) return this.use("axis");
            this.change({ [mark]: place });
            this.use(mark);
        });
    }

    private showOrder(): void {
        const { tool } = this;
        const { value } = this.history;
        const isDrawn = (each: CapTool): boolean =>
            each === "centre" || each === "stemEnd"
                ? !!value[each]
                : strokesOf(value.gesture, each).length > 0;
        for (const [each, button] of this.buttons) {
            button.setAttribute("aria-pressed", String(each === tool));
            button.classList.toggle("done", isDrawn(each));
        }
        if (!tool || !this.stored) return;
        const { pending } = this.sketch;
        const isMark = tool === "centre" || tool === "stemEnd";
        const moves = isDrawn(tool) && tool !== "keep" && tool !== "drop";
        byId("cap-sentence").textContent = !moves
            ? wordsOf[this.side_][tool].sentence
            : isMark
              ? "Drag it, or move it with the arrow keys"
              : "Drag its points, or draw it anew";
        byId("cap-stroke-tools").hidden = pending === 0;
        byId<HTMLButtonElement>("cap-finish").disabled = pending < 2;
        byId("cap-clear").hidden = !isDrawn(tool) || pending > 0;
        byId("cap-points").hidden = isMark;
        if (!isMark) this.table.show(value.gesture, tool, this.stored);
    }

    private key(event: KeyboardEvent): void {
        // Escape on the photograph takes a point back and must not discard all that is drawn.
        if (event.key === "Escape" && byId("cap-sketch").contains(event.target as Node))
            event.preventDefault();
        const { target } = event;
        if (target instanceof HTMLInputElement) return;
        const pressed = event.key.toLowerCase();
        const isStep = (pressed === "z" || pressed === "y") && (event.ctrlKey || event.metaKey);
        if (!isStep || event.altKey) return;
        event.preventDefault();
        event.stopPropagation();
        this.step(pressed === "y" || event.shiftKey ? "redo" : "undo");
    }
}
