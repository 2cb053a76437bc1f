// What the service's description says of a species' document and of a trace, fetched once.
import { getJson } from "../http";
import type { Schema } from "../schema";

export interface DocumentSchema extends Omit<Schema, "default" | "properties"> {
    "x-default"?: unknown;
    items?: DocumentSchema;
    minItems?: number;
    maxItems?: number;
    maxLength?: number;
    properties?: Record<string, DocumentSchema>;
}

export interface Description {
    components: {
        schemas: Record<string, DocumentSchema>;
        requestBodies: Record<
            string,
            { content: Record<string, { schema: DocumentSchema }> } | undefined
        >;
    };
}

let description: Promise<Description> | undefined;

export function described(): Promise<Description> {
    description ??= getJson<Description>("openapi.json");
    // What has failed is tried again the next time.
    description.catch(() => (description = undefined));
    return description;
}

/** Returns the schema of a species' document. */
export async function speciesSchema(): Promise<DocumentSchema> {
    return (await described()).components.schemas["species"] ?? {};
}

/** Returns the forms that the service can look for on a photograph. */
export async function tracedForms(): Promise<string[]> {
    const body = (await described()).components.requestBodies["trace_order"];
    const form = body?.content["application/json"]?.schema.properties?.["form"];
    return (form?.enum ?? []).map(String);
}
