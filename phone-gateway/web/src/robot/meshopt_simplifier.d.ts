/** What is used of a file of three.js that comes without types. */
declare module "three/examples/jsm/libs/meshopt_simplifier.module.js" {
  export const MeshoptSimplifier: {
    ready: Promise<void>;
    simplify(indices: Uint32Array, positions: Float32Array, stride: number, targetIndexCount: number, targetError: number,
             flags: readonly string[]): [indices: Uint32Array, error: number];
  };
}
