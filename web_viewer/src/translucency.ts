// Light that passes through thin flesh and leaves: a plugin for KHR_materials_diffuse_transmission,
// which the loader of three.js does not know. The base colour filters that light, as in the files
// of the service, in which the texture of its colour is that of the base colour.
import { Color, NoColorSpace, type Texture, type WebGLProgramParametersWithUniforms } from "three";
import type { GLTFLoaderPlugin, GLTFParser } from "three/addons/loaders/GLTFLoader.js";

const extension = "KHR_materials_diffuse_transmission";

interface Transmission {
    diffuseTransmissionFactor?: number;
    diffuseTransmissionTexture?: { index: number };
    diffuseTransmissionColorFactor?: [number, number, number];
}

interface TranslucentJson {
    materials?: { extensions?: Record<string, Transmission | undefined> }[];
}

const declarations = /* glsl */ `
uniform float transmissionShare;
uniform vec3 transmissionTint;
#ifdef THINNESS_MAP
    uniform sampler2D thinnessMap;
#endif
`;

// The shadow of the sun holds far sides, of which a surface that faces away from the sun is one: a
// larger bias than that of its lit sides keeps its own flesh from shading it. What other flesh
// stops passes by the same share, since it is about as thin.
const throughFlesh = /* glsl */ `
float passing = transmissionShare;
#if defined( THINNESS_MAP ) && defined( USE_MAP )
    passing *= texture2D( thinnessMap, vMapUv ).a;
#endif
vec3 sunBehind = vec3( 0.0 ), skyBehind = vec3( 0.0 );
#if NUM_DIR_LIGHTS > 0
    float reached, scattered = 0.25;
    #if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
        DirectionalLightShadow sunShadow;
    #endif
    #pragma unroll_loop_start
    for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
        reached = scattered - dot( geometryNormal, directionalLights[ i ].direction );
        reached = saturate( reached / ( 1.0 + scattered ) );
        #if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
        sunShadow = directionalLightShadows[ i ];
        if ( reached > 0.0 && receiveShadow ) {
            reached *= mix( getShadow( directionalShadowMap[ i ], sunShadow.shadowMapSize,
                sunShadow.shadowIntensity, sunShadow.shadowBias - 0.003, sunShadow.shadowRadius,
                vDirectionalShadowCoord[ i ] ), 1.0, passing );
        }
        #endif
        sunBehind += reached * directionalLights[ i ].color;
    }
    #pragma unroll_loop_end
#endif
#if NUM_HEMI_LIGHTS > 0
    #pragma unroll_loop_start
    for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
        skyBehind += getHemisphereLightIrradiance( hemisphereLights[ i ], - geometryNormal );
    }
    #pragma unroll_loop_end
#endif
#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
    skyBehind += getIBLIrradiance( - geometryNormal );
#endif
vec3 passed = passing * BRDF_Lambert( transmissionTint * diffuseColor.rgb );
reflectedLight.directDiffuse *= 1.0 - passing;
reflectedLight.directDiffuse += passed * sunBehind;
reflectedLight.indirectDiffuse *= 1.0 - passing;
reflectedLight.indirectDiffuse += passed * skyBehind;
`;

/** Returns what makes the shader of a material let light through. */
function shaderOf(
    { diffuseTransmissionFactor = 0, diffuseTransmissionColorFactor = [1, 1, 1] }: Transmission,
    thinness: Texture | undefined,
): (shader: WebGLProgramParametersWithUniforms) => void {
    return (shader) => {
        shader.uniforms["transmissionShare"] = { value: diffuseTransmissionFactor };
        shader.uniforms["transmissionTint"] = {
            value: new Color().fromArray(diffuseTransmissionColorFactor),
        };
        if (thinness) shader.uniforms["thinnessMap"] = { value: thinness };
        shader.fragmentShader = shader.fragmentShader
            .replace(
                "void main() {",
                `${thinness ? "#define THINNESS_MAP" : ""}\n${declarations}\nvoid main() {`,
            )
            .replace(
                "#include <lights_fragment_end>",
                `#include <lights_fragment_end>\n${throughFlesh}`,
            );
    };
}

/** Returns a loader plugin that lets light through the materials of a file, and adds their images
 *  of thinness to `textures`, because no material has them as a member. */
export function translucency(textures: Set<Texture>): (parser: GLTFParser) => GLTFLoaderPlugin {
    return (parser) => ({
        name: extension,
        extendMaterialParams: async (index, params) => {
            const material = (parser.json as TranslucentJson).materials?.[index];
            const through = material?.extensions?.[extension];
            if (!through?.diffuseTransmissionFactor) return;
            const image = through.diffuseTransmissionTexture;
            let thinness: Texture | undefined;
            if (image) {
                thinness = (await parser.getDependency("texture", image.index)) as Texture;
                thinness.colorSpace = NoColorSpace;
                textures.add(thinness);
            }
            Object.assign(params, {
                onBeforeCompile: shaderOf(through, thinness),
                // Shaders are shared by this key.
                customProgramCacheKey: () => (thinness ? "thinness" : "translucency"),
            });
        },
    });
}
