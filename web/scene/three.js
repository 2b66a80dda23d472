// three.js r111 as the program serves it: the only place that names its path.
export * from '../vendor/three/build/three.module.js';
export { OrbitControls } from '../vendor/three/examples/jsm/controls/OrbitControls.js';
