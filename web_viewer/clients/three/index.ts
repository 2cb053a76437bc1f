// Sporeprint for three.js: loading, levels of detail, impostors, batching, variants and wind.
export {
    Field,
    prototypesOf,
    type FieldCounts,
    type Placement,
    type Prototype,
    type PrototypeLevel,
} from "./field";
export { Impostor, impostorExtrasOf, type ImpostorExtras } from "./impostor";
export { RequestRefused, Sporeprint, type SetOrder } from "./server";
export { MaterialVariants } from "./variants";
export { Wind, windOf, type WindExtras } from "./wind";
