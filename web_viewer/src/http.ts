// Requests to the service: JSON and models, with progress, retries after 429 and 503, and every
// failure as one readable error.

export interface ProblemItem {
    parameter: string;
    detail: string;
}

/** A failed request, described by the service's problem details (RFC 9457) if it sent any. */
export class RequestFailed extends Error {
    constructor(
        readonly title: string,
        readonly detail: string,
        readonly status: number,
        readonly items: ProblemItem[] = [],
    ) {
        super(detail ? `${title}: ${detail}` : title);
    }
}

/** Returns any other error as a failed request with this title. */
export function asRequestFailed(error: unknown, title: string): RequestFailed {
    if (error instanceof RequestFailed) return error;
    return new RequestFailed(title, error instanceof Error ? error.message : "", 0);
}

export type Progress =
    | { stage: "growing" }
    | { stage: "downloading"; received: number; total: number | undefined }
    | { stage: "waiting"; seconds: number; attempt: number; attempts: number };

export interface FetchedModel {
    bytes: ArrayBuffer;
    response: Response;
    /** Origin of the body: the server, the browser's cache, or the cache after a 304. */
    source: "server" | "browser" | "confirmed";
}

const attempts = 6;
const longestWait = 20;

/** Returns the seconds to wait by a Retry-After header, a number or a date; 1 without one. */
export function retryAfter(header: string | null, now: number): number {
    if (!header) return 1;
    const seconds = /^\d+$/.test(header.trim())
        ? Number(header)
        : (Date.parse(header) - now) / 1000;
    return Number.isFinite(seconds) ? Math.min(Math.max(seconds, 0.25), longestWait) : 1;
}

function pause(seconds: number, signal?: AbortSignal): Promise<void> {
    return new Promise((resolve, reject) => {
        const stop = (): void => {
            clearTimeout(timer);
            reject(signal?.reason ?? new DOMException("stopped", "AbortError"));
        };
        const timer = setTimeout(() => {
            signal?.removeEventListener("abort", stop);
            resolve();
        }, seconds * 1000);
        if (signal?.aborted) stop();
        else signal?.addEventListener("abort", stop, { once: true });
    });
}

async function failureOf(response: Response): Promise<RequestFailed> {
    const type = response.headers.get("content-type") ?? "";
    if (type.includes("json")) {
        try {
            const problem = (await response.json()) as {
                title?: string;
                detail?: string;
                instance?: string;
                errors?: ProblemItem[];
            };
            const id =
                response.status >= 500 && problem.instance ? ` (request ${problem.instance})` : "";
            return new RequestFailed(
                problem.title ?? `The server responded with ${response.status}`,
                (problem.detail ?? "") + id,
                response.status,
                Array.isArray(problem.errors) ? problem.errors : [],
            );
        } catch {
            // The body is not JSON: the status has to suffice.
        }
    }
    return new RequestFailed(
        `The server responded with ${response.status}`,
        response.statusText,
        response.status,
    );
}

/** Sends one request; after 429 and 503 it is repeated a few times, after the time the server
 *  names. */
export async function send(
    address: string,
    init: RequestInit = {},
    report: (progress: Progress) => void = () => undefined,
): Promise<Response> {
    for (let attempt = 1; ; ++attempt) {
        report({ stage: "growing" });
        let response: Response;
        try {
            response = await fetch(address, init);
        } catch (error) {
            if (init.signal?.aborted) throw error;
            throw new RequestFailed("The server cannot be reached", "Is it running?", 0);
        }
        if (response.ok) return response;
        const busy = response.status === 429 || response.status === 503;
        if (!busy || attempt >= attempts) throw await failureOf(response);
        await response.body?.cancel();
        const seconds = retryAfter(response.headers.get("retry-after"), Date.now());
        report({ stage: "waiting", seconds, attempt, attempts });
        await pause(seconds, init.signal ?? undefined);
    }
}

export async function getJson<T>(address: string, signal?: AbortSignal): Promise<T> {
    const response = await send(address, signal ? { signal } : {});
    return (await response.json()) as T;
}

/** Fetches a model and reports each piece that arrives; a request with a body is posted. */
export async function getModel(
    { address, body }: { address: string; body?: string | undefined },
    signal: AbortSignal,
    report: (progress: Progress) => void = () => undefined,
): Promise<FetchedModel> {
    const posted =
        body === undefined
            ? {}
            : { method: "POST", body, headers: { "Content-Type": "application/json" } };
    const response = await send(address, { ...posted, signal }, report);
    const length = Number(response.headers.get("content-length"));
    const plain = !response.headers.get("content-encoding");
    const total = plain && length > 0 ? length : undefined;
    const pieces: Uint8Array[] = [];
    let received = 0;
    const reader = response.body?.getReader();
    report({ stage: "downloading", received, total });
    for (;;) {
        const next = await reader?.read();
        if (!next || next.done) break;
        pieces.push(next.value);
        received += next.value.byteLength;
        report({ stage: "downloading", received, total });
    }
    const bytes = new Uint8Array(received);
    let at = 0;
    for (const piece of pieces) {
        bytes.set(piece, at);
        at += piece.byteLength;
    }
    const timing = performance.getEntriesByName(response.url, "resource").at(-1) as
        PerformanceResourceTiming | undefined;
    const { transferSize = 0, encodedBodySize = 0 } = timing ?? {};
    const source =
        transferSize >= encodedBodySize ? "server" : transferSize === 0 ? "browser" : "confirmed";
    performance.clearResourceTimings();
    return { bytes: bytes.buffer, response, source };
}
