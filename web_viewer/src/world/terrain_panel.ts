// Terrains of one's own: a file of heights is sent to the service, and the world stands on it.
import { byId } from "../dom";
import { asRequestFailed, getJson, send, type RequestFailed } from "../http";
import { announce } from "../status_line";

/** What the service says of a terrain that it has stored. */
interface TerrainFacts {
    terrain: string;
    side: number;
    metres: number;
    lowest: number;
    highest: number;
}

export interface TerrainPanelEvents {
    /** A terrain was stored, and the world is to stand on it; nothing for hills that are grown. */
    chosen: (terrain: string | undefined) => void;
    failed: (failure: RequestFailed) => void;
}

export class TerrainPanel {
    private readonly file = byId<HTMLInputElement>("terrain-file");
    private readonly numbers = ["metres", "min", "max"].map((name) => [name, byId<HTMLInputElement>(`terrain-${name}`)] as const);
    private readonly use = byId<HTMLButtonElement>("terrain-use");
    private shown = "";

    constructor(private readonly events: TerrainPanelEvents) {
        this.use.addEventListener("click", () => void this.upload());
        byId("terrain-none").addEventListener("click", () => this.events.chosen(undefined));
    }

    /** Offers itself, where the service stores terrains. */
    offer(): void {
        byId("own-terrain").hidden = false;
    }

    /** Tells of the terrain that the world stands on; "" for none. */
    async show(terrain: string): Promise<void> {
        byId("terrain-none").hidden = terrain === "";
        if (terrain === this.shown) return;
        this.shown = terrain;
        const about = byId("terrain-about");
        about.textContent = "";
        if (terrain === "") return;
        try {
            const facts = await getJson<TerrainFacts>(`v1/terrains/${terrain}.json`);
            if (this.shown !== terrain) return;
            const { side, metres, lowest, highest } = facts;
            about.textContent = `${side} × ${side} heights over ${metres} m, from ${lowest.toFixed(1)} to ${highest.toFixed(1)} m`;
        } catch {
            this.shown = ""; // the description of the world tells why
        }
    }

    private async upload(): Promise<void> {
        const file = this.file.files?.[0];
        const wrong = [this.file, ...this.numbers.map(([, input]) => input)].find((input) => !input.validity.valid);
        if (!file || wrong) {
            (wrong ?? this.file).reportValidity();
            return;
        }
        this.use.disabled = true;
        announce(`${file.name} is sent`);
        try {
            const query = new URLSearchParams(this.numbers.map(([name, { value }]) => [name, value]));
            const response = await send(`v1/terrains?${query}`, { method: "POST", headers: { "Content-Type": "image/png" }, body: file });
            const { terrain } = (await response.json()) as TerrainFacts;
            announce(`The world stands on ${file.name}`);
            this.events.chosen(terrain);
        } catch (error) {
            this.events.failed(asRequestFailed(error, `${file.name} is no terrain`));
        } finally {
            this.use.disabled = false;
        }
    }
}
