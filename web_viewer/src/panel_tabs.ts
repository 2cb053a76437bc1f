// The tabs of a panel beside the stage: of the page, and of the designer.
import { byId } from "./dom";

export class PanelTabs<Name extends string> {
    /** `chosen` is called when the user opens a panel. */
    constructor(
        private readonly panels: readonly Name[],
        private readonly chosen: (name: Name) => void,
    ) {
        for (const [index, name] of panels.entries()) {
            const tab = byId(`tab-${name}`);
            tab.addEventListener("click", () => this.choose(name));
            tab.addEventListener("keydown", ({ key }) => {
                const steps: Record<string, number> = { ArrowRight: 1, ArrowLeft: -1 };
                const step = steps[key];
                if (step === undefined) return;
                const shown = (one: Name): boolean => !byId(`tab-${one}`).hidden;
                const after = [...panels.slice(index + 1), ...panels.slice(0, index)].filter(shown);
                const next = after.at(step > 0 ? 0 : -1) ?? name;
                this.choose(next);
                byId(`tab-${next}`).focus();
            });
        }
    }

    /** Opens a panel and closes the others. */
    open(name: Name): void {
        for (const one of this.panels) {
            const tab = byId(`tab-${one}`);
            tab.setAttribute("aria-selected", String(one === name));
            tab.tabIndex = one === name ? 0 : -1;
            byId(`panel-${one}`).hidden = one !== name;
        }
    }

    private choose(name: Name): void {
        this.open(name);
        this.chosen(name);
    }
}
