// Impostors for three.js: draws the level of detail 4 as one quad that faces the camera and shows the
// nearest of its pictures, with the light of the scene.
import {
    BufferAttribute,
    BufferGeometry,
    InstancedMesh,
    Mesh,
    MeshDepthMaterial,
    MeshStandardMaterial,
    RGBADepthPacking,
    ShaderChunk,
    Sphere,
    Vector3,
    type IUniform,
    type Material,
    type Object3D,
    type Texture,
    type WebGLProgramParametersWithUniforms,
} from "three";

/** What the material of an impostor states, in `extras.impostor`. */
export interface ImpostorExtras {
    mapping: "hemi_octahedral";
    /** Frames in each row and column of the images. */
    grid: number;
    /** Side of a frame, and of the images; the first frame is at their left upper corner. */
    frame_texels: number;
    side_texels: number;
    /** The middle of all frames and half the side of the square that each shows, metres. */
    centre_m: [number, number, number];
    radius_m: number;
    /** Size of a texel: an impostor looks like the mesh where this is a pixel. */
    texel_m: number;
    /** Length of the mean of the unit normals of a few texels: how far those of one texel differ. */
    normal_length: number;
    /** The texture and the channel of the depth: 0.5 is the plane through the centre, 1 `radius_m` nearer. */
    depth: string;
}

/** Returns what a material states about its impostor, undefined if it is of something else. */
export function impostorExtrasOf(material: Material): ImpostorExtras | undefined {
    const extras = (material.userData as { impostor?: ImpostorExtras }).impostor;
    return extras?.mapping === "hemi_octahedral" ? extras : undefined;
}

const shared = /* glsl */ `
// Returns the axes of a view: up is the projection of +Y, from above -Z.
void impostorAxes(vec3 toward, out vec3 right, out vec3 up) {
    vec3 level = vec3(0.0, 1.0, 0.0) - toward * toward.y;
    up = dot(level, level) > 1e-8 ? normalize(level) : vec3(0.0, 0.0, -1.0);
    right = cross(up, toward);
}
`;

const vertexDeclarations = /* glsl */ `
uniform vec3 impostorCentre;
uniform float impostorRadius;
flat varying vec3 vImpostorToward;
varying vec3 vImpostorPoint;
varying vec3 vImpostorRay;
#ifndef IMPOSTOR_DEPTH
flat varying mat3 vImpostorNormals;
#endif
${shared}`;

const vertexMain = /* glsl */ `
mat4 impostorModel = modelMatrix;
#ifdef USE_INSTANCING
    impostorModel = impostorModel * instanceMatrix;
#endif
mat4 impostorFromWorld = inverse(impostorModel);
vec3 impostorEye = (impostorFromWorld * vec4(cameraPosition, 1.0)).xyz - impostorCentre;
// The third row of the view matrix points from the scene to the camera.
vec3 impostorBack = vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]);
float impostorDistance = length(impostorEye);
vImpostorToward = isOrthographic
    ? normalize(mat3(impostorFromWorld) * impostorBack)
    : impostorEye / max(impostorDistance, 1e-6);
vec3 impostorRight, impostorUp;
impostorAxes(vImpostorToward, impostorRight, impostorUp);
// In perspective the outline of a ball is larger than its section.
float impostorShare = isOrthographic ? 0.0 : min(impostorRadius / impostorDistance, 0.9);
float impostorGrowth = inversesqrt(1.0 - impostorShare * impostorShare);
vImpostorPoint = (impostorRight * position.x + impostorUp * position.y) * impostorGrowth;
vImpostorRay = isOrthographic
    ? -vImpostorToward
    : vImpostorPoint * impostorRadius - impostorEye;
#ifndef IMPOSTOR_DEPTH
    vImpostorNormals = mat3(viewMatrix) * transpose(mat3(impostorFromWorld));
#endif
vec3 transformed = impostorCentre + impostorRadius * vImpostorPoint;
`;

const fragmentFunctions = /* glsl */ `
uniform sampler2D impostorSurfaces;
uniform float impostorGrid;
uniform float impostorFrame;
uniform float impostorShare;
flat varying vec3 vImpostorToward;
varying vec3 vImpostorPoint;
varying vec3 vImpostorRay;
#ifndef IMPOSTOR_DEPTH
uniform sampler2D impostorNormals;
flat varying mat3 vImpostorNormals;
#endif
${shared}
// What the frames show at this fragment: colour and coverage, normal, roughness; the sum of weights.
vec4 impostorColour;
vec3 impostorNormal;
float impostorRoughness;
float impostorTrust;

// The hemi-octahedral map and its inverse; below the horizon the place is that of the azimuth.
vec2 impostorPlace(vec3 direction) {
    direction.y = max(direction.y, 0.0);
    direction /= max(abs(direction.x) + direction.y + abs(direction.z), 1e-6);
    return 0.5 * vec2(direction.x - direction.z, direction.x + direction.z) + 0.5;
}

vec3 impostorDirection(vec2 place) {
    vec2 at = 2.0 * place - 1.0;
    return normalize(vec3(0.5 * (at.x + at.y), 1.0 - max(abs(at.x), abs(at.y)), 0.5 * (at.y - at.x)));
}

void addImpostorFrame(vec2 cell, float weight) {
    vec3 toward = impostorDirection(cell / (impostorGrid - 1.0));
    vec3 right, up;
    impostorAxes(toward, right, up);
    // The ray meets the plane of the frame through the centre at one point, and from there moves
    // this far along the frame for each unit of depth.
    float slope = min(dot(vImpostorRay, toward), -1e-4 * length(vImpostorRay));
    vec3 onPlane = vImpostorPoint - vImpostorRay * (dot(vImpostorPoint, toward) / slope);
    vec2 place = vec2(dot(onPlane, right), dot(onPlane, up));
    vec2 shift = vec2(dot(vImpostorRay, right), dot(vImpostorRay, up)) / slope;
    float inside = 1.0 - 1.0 / impostorFrame;
    vec2 at = vec2(0.0);
    vec2 surface = vec2(0.0);
    float depth = 0.0;
    float miss = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 moved = clamp(place + shift * depth, -inside, inside);
        at = (cell + vec2(0.5 + 0.5 * moved.x, 0.5 - 0.5 * moved.y)) * impostorShare;
        surface = texture2D(impostorSurfaces, at).rg;
        miss = 2.0 * surface.r - 1.0 - depth;
        if (i < 3) depth += miss;
    }
    // Where this frame shows something before or behind the ray, the others count.
    float trust = weight / (1.0 + 100.0 * miss * miss);
    vec4 colour = texture2D(map, at);
    float share = trust * colour.a;
    impostorColour += vec4(colour.rgb * share, share);
    impostorRoughness += surface.g * share;
    impostorTrust += trust;
#ifndef IMPOSTOR_DEPTH
    vec3 normal = 2.0 * texture2D(impostorNormals, at).xyz - 1.0;
    impostorNormal += (right * normal.x + up * normal.y + toward * normal.z) * share;
#endif
}

// Blends the three frames around the direction of the camera.
void readImpostor() {
    impostorColour = vec4(0.0);
    impostorNormal = vec3(0.0);
    impostorRoughness = 0.0;
    impostorTrust = 0.0;
    vec2 place = impostorPlace(vImpostorToward) * (impostorGrid - 1.0);
    vec2 cell = min(floor(place), impostorGrid - 2.0);
    vec2 part = place - cell;
    bool isRight = part.x > part.y;
    addImpostorFrame(cell, 1.0 - max(part.x, part.y));
    addImpostorFrame(cell + (isRight ? vec2(1.0, 0.0) : vec2(0.0, 1.0)), abs(part.x - part.y));
    addImpostorFrame(cell + 1.0, min(part.x, part.y));
    float share = 1.0 / max(impostorColour.a, 1e-4);
    impostorColour.rgb *= share;
    impostorRoughness *= share;
    impostorColour.a /= max(impostorTrust, 1e-4);
}

void main() {`;

// Leaves smaller than a texel face many ways: seen against the light some are lit, and seen with it
// some are not. The mean of the cosine over them takes the place of that of their mean normal.
const litFunctions = /* glsl */ `
uniform float impostorNormalLength;
float impostorCosine(float meanCosine) {
    float cosine = impostorNormalLength * meanCosine;
    float spread = 1.0 - impostorNormalLength * impostorNormalLength;
    return 0.5 * (cosine + sqrt(cosine * cosine + 0.4 * spread));
}
`;

/** The chunks of the shaders of three.js that are replaced. */
const replacedInLit: Record<string, string> = {
    "#include <lights_physical_pars_fragment>":
        litFunctions +
        ShaderChunk.lights_physical_pars_fragment.replace(
            "saturate( dot( geometryNormal, directLight.direction ) )",
            "impostorCosine( dot( geometryNormal, directLight.direction ) )",
        ),
    "#include <roughnessmap_fragment>":
        "float roughnessFactor = roughness * impostorRoughness;",
    "#include <normal_fragment_maps>":
        "normal = normalize(vImpostorNormals * impostorNormal);",
    "#include <emissivemap_fragment>": "totalEmissiveRadiance *= impostorColour.rgb;",
};

/** Returns a quad that the shader turns to the camera. */
function quadOf({ centre_m, radius_m }: ImpostorExtras): BufferGeometry {
    const quad = new BufferGeometry();
    const corners = [-1, -1, 1, -1, 1, 1, -1, 1];
    const positions: number[] = [];
    const normals: number[] = [];
    const coordinates: number[] = [];
    for (let i = 0; i < corners.length; i += 2) {
        const [x, y] = [corners[i]!, corners[i + 1]!];
        positions.push(x, y, 0);
        normals.push(0, 0, 1);
        coordinates.push(0.5 + 0.5 * x, 0.5 - 0.5 * y);
    }
    quad.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    quad.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
    quad.setAttribute("uv", new BufferAttribute(new Float32Array(coordinates), 2));
    quad.setIndex([0, 1, 2, 0, 2, 3]);
    quad.boundingSphere = new Sphere(new Vector3(...centre_m), radius_m * Math.SQRT2);
    return quad;
}

/** The impostor of a product, of which any number of individuals may be drawn. */
export class Impostor {
    readonly extras: ImpostorExtras;
    readonly geometry: BufferGeometry;
    readonly material: MeshStandardMaterial;

    private readonly shadow: MeshDepthMaterial;

    /** @param material of the cards, as GLTFLoader makes it of `extras.impostor`
     *  @throws Error for a material of something else */
    constructor(material: Material) {
        const extras = impostorExtrasOf(material);
        if (!(material instanceof MeshStandardMaterial) || !extras)
            throw new Error(`the material '${material.name}' is not that of an impostor`);
        const { map, normalMap, roughnessMap } = material;
        if (!map || !normalMap || !roughnessMap)
            throw new Error(`the impostor '${material.name}' has no images`);
        this.extras = extras;
        this.geometry = quadOf(extras);
        this.material = material.clone();
        // The shader reads these images itself.
        Object.assign(this.material, {
            normalMap: null,
            roughnessMap: null,
            metalnessMap: null,
            aoMap: null,
            emissiveMap: null,
        });
        this.patch(this.material, normalMap, roughnessMap, false);
        this.shadow = new MeshDepthMaterial({
            depthPacking: RGBADepthPacking,
            map,
            alphaTest: material.alphaTest,
        });
        this.patch(this.shadow, normalMap, roughnessMap, true);
    }

    /** Returns the impostor in a scene of a file with lod=4, or at the end of its levels.
     *
     *  @param root the scene, or a node outside of it that MSFT_lod names
     *  @throws Error if there is none */
    static of(root: Object3D): Impostor {
        let found: Material | undefined;
        root.traverse((node) => {
            const material = node instanceof Mesh ? (node.material as Material) : undefined;
            if (material && !Array.isArray(material) && impostorExtrasOf(material))
                found ??= material;
        });
        if (!found) throw new Error(`'${root.name}' has no impostor`);
        return new Impostor(found);
    }

    /** Returns a mesh at the place of the product. */
    mesh(): Mesh {
        return this.prepared(new Mesh(this.geometry, this.material));
    }

    /** Returns a mesh of many individuals, whose matrices the caller sets. */
    instanced(count: number): InstancedMesh {
        return this.prepared(new InstancedMesh(this.geometry, this.material, count));
    }

    dispose(): void {
        this.geometry.dispose();
        this.material.dispose();
        this.shadow.dispose();
    }

    private prepared<T extends Mesh>(mesh: T): T {
        mesh.customDepthMaterial = this.shadow;
        return mesh;
    }

    private patch(material: Material, normals: Texture, surfaces: Texture, isDepth: boolean): void {
        const { centre_m, radius_m, grid, frame_texels, side_texels, normal_length } = this.extras;
        const uniforms: Record<string, IUniform> = {
            impostorNormals: { value: normals },
            impostorSurfaces: { value: surfaces },
            impostorCentre: { value: new Vector3(...centre_m) },
            impostorRadius: { value: radius_m },
            impostorGrid: { value: grid },
            impostorFrame: { value: frame_texels },
            impostorShare: { value: frame_texels / side_texels },
            impostorNormalLength: { value: normal_length },
        };
        material.customProgramCacheKey = () => `sporeprint impostor ${isDepth}`;
        material.onBeforeCompile = (shader: WebGLProgramParametersWithUniforms) => {
            Object.assign(shader.uniforms, uniforms);
            const define = isDepth ? "#define IMPOSTOR_DEPTH\n" : "";
            shader.vertexShader = `${define}${vertexDeclarations}${shader.vertexShader}`.replace(
                "#include <begin_vertex>",
                vertexMain,
            );
            let fragment = `${define}${shader.fragmentShader}`
                .replace("void main() {", fragmentFunctions)
                .replace(
                    "#include <map_fragment>",
                    "readImpostor();\ndiffuseColor *= impostorColour;",
                );
            if (!isDepth)
                for (const [chunk, code] of Object.entries(replacedInLit))
                    fragment = fragment.replace(chunk, code);
            shader.fragmentShader = fragment;
        };
        material.needsUpdate = true;
    }
}
