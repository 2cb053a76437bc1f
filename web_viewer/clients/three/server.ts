// Fetches files of a Sporeprint server, and keeps them for the next visit.
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { GLTFLoader, type GLTF } from "three/addons/loaders/GLTFLoader.js";
import type { components } from "./api";

/** The body of POST /v1/sets.glb: species and the parameters of a set and of a mushroom. */
export type SetOrder = components["requestBodies"]["set_order"]["content"]["application/json"];

type Problem = components["schemas"]["problem"];

/** An error response of the server. */
export class RequestRefused extends Error {
    constructor(
        readonly status: number,
        /** As the server put it: which parameter, its value, and what is allowed. */
        readonly details: string[],
        url: string,
    ) {
        super(`${url} responded with ${status}: ${details.join("; ")}`);
        this.name = "RequestRefused";
    }
}

async function refusal(response: Response, url: string): Promise<RequestRefused> {
    const problem = (await response.json().catch(() => ({}))) as Partial<Problem>;
    const details = problem.errors?.map(({ detail }) => detail) ?? [
        problem.title ?? response.statusText,
    ];
    return new RequestRefused(response.status, details, url);
}

/** Times a request is repeated while the server is busy. */
const mostRetries = 5;

export class Sporeprint {
    private readonly loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);

    /** @param server its URL without a path: "https://example.org"
     *  @param cache holds responses to POST, which browsers do not cache; those to GET are cached by
     *  the browser itself */
    constructor(
        private readonly server: string,
        private readonly cache?: Cache,
    ) {}

    /** Loads a product by its path and query: "trees/birch.glb?lods=msft&wind=uv".
     *
     *  @throws RequestRefused */
    async load(path: string): Promise<GLTF> {
        const url = `${this.server}/v1/${path}`;
        return this.parse(await (await this.fetch(url, {})).arrayBuffer(), url);
    }

    /** Loads a set of mushrooms as one file.
     *
     *  @throws RequestRefused */
    async loadSet(order: SetOrder): Promise<GLTF> {
        const url = `${this.server}/v1/sets.glb`;
        const body = JSON.stringify(order);
        const headers: Record<string, string> = { "Content-Type": "application/json" };
        if (!this.cache) {
            const response = await this.fetch(url, { method: "POST", headers, body });
            return this.parse(await response.arrayBuffer(), url);
        }
        const key = `${url}?${await hashOf(body)}`;
        const stored = await this.cache.match(key);
        const etag = stored?.headers.get("ETag");
        if (etag) headers["If-None-Match"] = etag;
        const response = await this.fetch(url, { method: "POST", headers, body }, Boolean(etag));
        // RFC 9110, section 13.1.2: 412 says that the file is still that of the ETag.
        if (response.status === 412 && stored) return this.parse(await stored.arrayBuffer(), url);
        await this.cache.put(key, response.clone());
        return this.parse(await response.arrayBuffer(), url);
    }

    private parse(bytes: ArrayBuffer, url: string): Promise<GLTF> {
        return this.loader.parseAsync(bytes, new URL(".", url).href);
    }

    /** Requests a URL again while the server is busy. */
    private async fetch(url: string, init: RequestInit, conditional = false): Promise<Response> {
        for (let retry = 0; ; ++retry) {
            const response = await fetch(url, init);
            if (response.ok || (conditional && response.status === 412)) return response;
            const seconds = Number(response.headers.get("Retry-After"));
            if (response.status !== 503 || retry === mostRetries || !(seconds > 0))
                throw await refusal(response, url);
            await new Promise((resolve) => setTimeout(resolve, 1000 * seconds));
        }
    }
}

/** Returns a hash of a text as hexadecimal digits. */
async function hashOf(text: string): Promise<string> {
    const digest = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text));
    return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}
