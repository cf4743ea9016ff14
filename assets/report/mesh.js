// Numbers behind the 3-D view: matrices, colour scales, normals, line segments.

const HEIGHT_STOPS = [[58, 92, 184], [42, 150, 202], [60, 186, 140], [178, 202, 72], [245, 176, 58], [240, 92, 78]];
const SCAN_STOPS = [[94, 79, 162], [50, 136, 189], [92, 186, 150], [226, 196, 80], [240, 120, 67], [190, 30, 100]];

function rampColour(stops, share) {
  const at = Math.max(0, Math.min(1, share)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  return stops[i].map((c, k) => (c + (stops[i + 1][k] - c) * (at - i)) / 255);
}
const heightColour = (share) => rampColour(HEIGHT_STOPS, share);
const rampCss = (stops) => `linear-gradient(90deg, ${stops.map((c) => `rgb(${c.join(" ")})`).join(", ")})`;

function bytesFromBase64(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
// Little-endian, whatever the machine is.
function u16FromBase64(text) {
  const view = new DataView(bytesFromBase64(text).buffer);
  return Uint16Array.from({ length: view.byteLength / 2 }, (_, i) => view.getUint16(2 * i, true));
}

const Vec = {
  sub: (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]],
  add: (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]],
  scale: (a, s) => [a[0] * s, a[1] * s, a[2] * s],
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
  unit: (a) => Vec.scale(a, 1 / (Math.hypot(...a) || 1)),
};

// Column-major 4x4, as WebGL takes it.
function multiply(a, b) {
  const out = new Float32Array(16);
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 4; ++row) {
      for (let k = 0; k < 4; ++k) out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return out;
}

function perspective(fov_rad, aspect, near, far) {
  const f = 1 / Math.tan(fov_rad / 2);
  return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
}

function lookAt(eye, right, up, back) {
  return [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
    -Vec.dot(right, eye), -Vec.dot(up, eye), -Vec.dot(back, eye), 1];
}

// Per occupied voxel a normal, pointing away from the cells within two cells' distance, and how
// open its surroundings are; as four signed bytes. Unreliable normals come out short.
function voxelShading(packed, cells) {
  const count = packed.length / 4, [nx, ny, nz] = cells;
  const shading = new Int8Array(4 * count).fill(127);
  if (nx * ny * nz > 128e6) return shading.map((v, i) => (i % 4 === 3 ? 127 : 0));
  const filled = new Uint8Array(nx * ny * nz);
  const index = (x, y, z) => (z * ny + y) * nx + x;
  for (let i = 0; i < packed.length; i += 4) {
    if (!(packed[i + 3] & 0x8000)) filled[index(packed[i], packed[i + 1], packed[i + 2])] = 1;
  }
  for (let i = 0; i < packed.length; i += 4) {
    const [x, y, z] = [packed[i], packed[i + 1], packed[i + 2]];
    let sx = 0, sy = 0, sz = 0, weight = 0, above = 0;
    for (let dz = -2; dz <= 2; ++dz) {
      if (z + dz < 0 || z + dz >= nz) continue;
      for (let dy = -2; dy <= 2; ++dy) {
        if (y + dy < 0 || y + dy >= ny) continue;
        for (let dx = -2; dx <= 2; ++dx) {
          if (x + dx < 0 || x + dx >= nx || !filled[index(x + dx, y + dy, z + dz)]) continue;
          sx -= dx; sy -= dy; sz -= dz;
          weight += Math.abs(dx) + Math.abs(dy) + Math.abs(dz);
          if (dz > 0) ++above;
        }
      }
    }
    const length = Math.hypot(sx, sy, sz);
    const reliable = length > 0 ? Math.min(1, (5 * length) / Math.max(1, weight)) / length : 0;
    shading[i] = 127 * sx * reliable;
    shading[i + 1] = 127 * sy * reliable;
    shading[i + 2] = 127 * sz * reliable;
    shading[i + 3] = 127 * (1 - 0.5 * Math.min(1, above / 34));
  }
  return shading;
}

// Lines as instances of 12 floats: start, end, red, green, blue, opacity, width in px, step.
class LineList {
  constructor() { this.values = []; }
  add(a, b, colour, width_px, step = 0) {
    this.values.push(...a, ...b, ...colour, width_px, step);
  }
  route(points, colour, width_px) {
    for (let i = 1; i < points.length; ++i) this.add(points[i - 1].p, points[i].p, colour, width_px, points[i].step);
  }
  box(min, max, colour, width_px) {
    const corner = (i) => [i & 1 ? max[0] : min[0], i & 2 ? max[1] : min[1], i & 4 ? max[2] : min[2]];
    for (let i = 0; i < 8; ++i) {
      for (const bit of [1, 2, 4]) if (!(i & bit)) this.add(corner(i), corner(i | bit), colour, width_px);
    }
  }
  // A pyramid with its tip at the sensor, opening along its heading.
  frustum(view, length_m, colour, width_px, step = 0) {
    const c = Math.cos(view.yaw), s = Math.sin(view.yaw), tip = [view.x, view.y, view.z];
    const rim = [[0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2], [0.3, -0.2]].map(([y, z]) =>
      Vec.add(tip, Vec.scale([c - s * y, s + c * y, z], length_m)));
    for (let i = 0; i < 4; ++i) {
      this.add(tip, rim[i], colour, width_px, step);
      this.add(rim[i], rim[(i + 1) % 4], colour, width_px, step);
    }
  }
  get count() { return this.values.length / 12; }
}

// Three faces of a cube, +x +y +z, that the vertex shader mirrors towards the eye: per vertex the
// corner and the face's axis, and triangles.
function cubeCorner() {
  const vertices = [], triangles = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) {
      const corner = [0, 0, 0];
      corner[axis] = 0.5;
      corner[(axis + 1) % 3] = u / 2;
      corner[(axis + 2) % 3] = v / 2;
      const face = [0, 0, 0];
      face[axis] = 1;
      vertices.push(...corner, ...face);
    }
    const k = 4 * axis;
    triangles.push(k, k + 1, k + 2, k, k + 2, k + 3);
  }
  return { vertices: new Float32Array(vertices), triangles: new Uint16Array(triangles) };
}
