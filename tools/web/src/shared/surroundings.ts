// What stands round the figures on every stage: light, floor, grid, shadows.

import {
  BufferGeometry,
  CircleGeometry,
  Color,
  DirectionalLight,
  Float32BufferAttribute,
  Fog,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  type Scene,
  Vector3,
} from "three";
import { themeColour } from "./theme";

export const towardsLight = new Vector3(0.45, 1, 0.6);

// Whether the processor draws, so that each vertex and pixel counts.
export function drawsInSoftware(context: WebGL2RenderingContext): boolean {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  return /swiftshader|llvmpipe|softpipe|software/i.test(name);
}

// Pixels drawn per CSS pixel. A graphics card smooths edges by drawing more of them, which serves
// as well as multisampling.
export function pixelRatio(context: WebGL2RenderingContext): number {
  return drawsInSoftware(context) ? 1 : 2;
}

// Flattens a mesh onto the floor along the light: a shadow without a second pass.
export function shadowMaterial(): MeshBasicMaterial {
  const material = new MeshBasicMaterial();
  const light = towardsLight;
  const [sx, sz] = [light.x / light.y, light.z / light.y].map((x) => x.toFixed(4));
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace(
      "#include <project_vertex>",
      `
      #include <project_vertex>
      vec4 onFloor = modelMatrix * vec4(transformed, 1.0);
      onFloor.xz -= vec2(${sx}, ${sz}) * max(onFloor.y, 0.0);
      onFloor.y = 0.003;
      mvPosition = viewMatrix * onFloor;
      gl_Position = projectionMatrix * mvPosition;`,
    );
  };
  return material;
}

const kCell = 0.5; // m

// Each edge of a cell is a line of its own: software renderers drop lines that pass the camera.
function gridGeometry(): BufferGeometry {
  const half = 16; // cells; fog hides what is further away
  const points: number[] = [];
  for (let i = -half; i <= half; ++i) {
    for (let k = -half; k < half; ++k) {
      points.push(i * kCell, 0, k * kCell, i * kCell, 0, (k + 1) * kCell);
      points.push(k * kCell, 0, i * kCell, (k + 1) * kCell, 0, i * kCell);
    }
  }
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points, 3));
}

export interface Surroundings {
  floor: Mesh;
  grid: LineSegments;
  dress(): void; // takes the colours of the theme
  centre(x: number, z: number): void; // the grid goes with who looks, by whole cells
}

// Lights, floor and grid.
export function surround(scene: Scene): Surroundings {
  const sun = new DirectionalLight(0xffffff, 1.9);
  sun.position.copy(towardsLight);
  const sky = new HemisphereLight(0xffffff, 0x8a8f98, 1.7);
  // First and without depth: what lies on it is drawn over it.
  const floor = new Mesh(new CircleGeometry(30, 48), new MeshBasicMaterial({ depthWrite: false }));
  floor.renderOrder = -1;
  floor.rotation.x = -Math.PI / 2;
  floor.position.y = -0.002;
  const lines = new LineBasicMaterial();
  const grid = new LineSegments(gridGeometry(), lines);
  scene.add(sun, sky, floor, grid);
  scene.fog = new Fog(0xffffff, 5, 13);
  const dress = () => {
    const ground = new Color(themeColour("--stage"));
    scene.background = ground;
    (scene.fog as Fog).color = ground;
    (floor.material as MeshBasicMaterial).color = ground;
    lines.color.set(themeColour("--stage-grid"));
  };
  const centre = (x: number, z: number) =>
    void grid.position.set(kCell * Math.round(x / kCell), 0, kCell * Math.round(z / kCell));
  return { floor, grid, dress, centre };
}
