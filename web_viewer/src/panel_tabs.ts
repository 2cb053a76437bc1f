// The tabs of the panel beside the stage: how the model grows, and how it is exported.
import { byId } from "./dom";
import { panels, type PanelName } from "./view_state";

export class PanelTabs {
    /** `chosen` is called when the user opens a panel. */
    constructor(private readonly chosen: (name: PanelName) => void) {
        for (const [index, name] of panels.entries()) {
            const tab = byId(`tab-${name}`);
            tab.addEventListener("click", () => this.choose(name));
            tab.addEventListener("keydown", ({ key }) => {
                const steps: Record<string, number> = { ArrowRight: 1, ArrowLeft: -1 };
                const step = steps[key];
                if (step === undefined) return;
                const next = panels[(index + step + panels.length) % panels.length] ?? name;
                this.choose(next);
                byId(`tab-${next}`).focus();
            });
        }
    }

    /** Opens a panel and closes the others. */
    open(name: PanelName): void {
        for (const one of panels) {
            const tab = byId(`tab-${one}`);
            tab.setAttribute("aria-selected", String(one === name));
            tab.tabIndex = one === name ? 0 : -1;
            byId(`panel-${one}`).hidden = one !== name;
        }
    }

    private choose(name: PanelName): void {
        this.open(name);
        this.chosen(name);
    }
}
