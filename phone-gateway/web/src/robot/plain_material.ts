/** The robot's surface where a processor draws: light, tone and color are computed in each corner instead of each pixel, and
 * three numbers instead of nine are carried to the pixels. As MeshLambertMaterial otherwise. */
import {ShaderMaterial, UniformsLib, UniformsUtils} from "three";

const kVertexShader = `
  #include <common>
  #include <lights_pars_begin>
  #include <tonemapping_pars_fragment>
  #include <colorspace_pars_fragment>
  varying vec3 shade;
  void main() {
    vec3 seen = normalize(normalMatrix * normal);
    vec3 irradiance = vec3(0.0);
    #pragma unroll_loop_start
    for (int i = 0; i < NUM_DIR_LIGHTS; i++) {
      irradiance += saturate(dot(seen, directionalLights[i].direction)) * directionalLights[i].color;
    }
    #pragma unroll_loop_end
    #pragma unroll_loop_start
    for (int i = 0; i < NUM_HEMI_LIGHTS; i++) {
      irradiance += getHemisphereLightIrradiance(hemisphereLights[i], seen);
    }
    #pragma unroll_loop_end
    shade = sRGBTransferOETF(vec4(ACESFilmicToneMapping(irradiance * RECIPROCAL_PI * color), 1.0)).rgb;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

const kFragmentShader = `
  uniform float opacity;
  varying vec3 shade;
  void main() {
    gl_FragColor = vec4(shade, opacity);
  }`;

export class PlainMaterial extends ShaderMaterial {
  constructor() {
    super({
      vertexShader: kVertexShader, fragmentShader: kFragmentShader, vertexColors: true, lights: true, toneMapped: false,
      uniforms: {...UniformsUtils.clone(UniformsLib["lights"]), opacity: {value: 1}},
    });
  }

  setOpacity(opacity: number): void {
    this.uniforms["opacity"]!.value = opacity;
  }
}
