// The room of a flight in the 3-D view, with what was found in it.

function decodeSurfaces(scene) {
  if (!scene) return null;
  const triangles = bytesFromBase64(scene.triangles);
  const view = new DataView(triangles.buffer);
  return {
    ...scene, positions: u16FromBase64(scene.positions), colours: bytesFromBase64(scene.colours),
    triangles: Uint32Array.from({ length: triangles.length / 4 }, (_, i) => view.getUint32(4 * i, true)),
  };
}

function buildSurfaces(viewer) {
  const { gl, scene: { surfaces } } = viewer;
  if (!surfaces) return;
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  buffer(gl, gl.ARRAY_BUFFER, surfaces.positions);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, false, 6, 0);
  buffer(gl, gl.ARRAY_BUFFER, surfaces.colours);
  gl.enableVertexAttribArray(1);
  gl.vertexAttribPointer(1, 3, gl.UNSIGNED_BYTE, true, 3, 0);
  buffer(gl, gl.ELEMENT_ARRAY_BUFFER, surfaces.triangles);
  gl.bindVertexArray(null);
  viewer.surfaces = { array };
}

// Without the outer walls, and the ceiling, that the eye is beyond: parts are what is always drawn,
// then -x, +x, -y, +y, above.
function drawSurfaces(viewer, shot) {
  const { gl, scene: { surfaces }, programs: { surface: { made, uniforms: u } } } = viewer;
  const { min, max } = surfaces.extent, [x, y, z] = shot.eye;
  const beyond = [false, x < min[0], x > max[0], y < min[1], y > max[1], z > max[2]];
  gl.useProgram(made);
  gl.uniformMatrix4fv(u.worldToClip, false, shot.worldToClip);
  gl.uniform3fv(u.eye, shot.eye);
  gl.uniform3fv(u.toLight, shot.toLight);
  gl.uniform3fv(u.sceneMin, surfaces.min_m);
  gl.uniform3fv(u.sceneScale, surfaces.scale_m);
  gl.bindVertexArray(viewer.surfaces.array);
  let first = 0;
  surfaces.parts.forEach((count, part) => {
    if (count && !beyond[part]) gl.drawElements(gl.TRIANGLES, 3 * count, gl.UNSIGNED_INT, 12 * first);
    first += count;
  });
}

// Where objects were found, from where each was seen, and the path as given.
function flightLines(scene) {
  if (!scene.flight) return {};
  const lists = { given: new LineList(), looks: new LineList(), objects: new LineList() };
  const path = scene.flight.path.map(([x, y, z]) => ({ p: [x, y, z], step: 0 }));
  lists.given.route(path, themeColour("--dim", 0.8), 1.4);
  for (const look of scene.flight.looks) {
    const object = scene.flight.objects[look.object], step = stepAt(scene, look.time_s);
    const eye = [look.view.x_m, look.view.y_m, look.view.z_m];
    const aim = [object.x_m, object.y_m, object.z_m + 0.1];
    lists.looks.add(eye, aim, themeColour("--belief", 0.75), 1.6, step);
    for (const axis of [[0.05, 0, 0], [0, 0.05, 0], [0, 0, 0.05]]) {
      lists.looks.add(Vec.sub(eye, axis), Vec.add(eye, axis), themeColour("--belief"), 2.4, step);
    }
  }
  for (const found of METRICS.found ?? []) {
    const colour = themeColour(isNumber(found.object) ? "--view" : "--bad");
    const p = [found.x_m, found.y_m, found.z_m];
    lists.objects.add(p, Vec.add(p, [0, 0, 0.42]), colour, 2);
    lists.objects.box(Vec.sub(p, [0.13, 0.13, 0.02]), Vec.add(p, [0.13, 0.13, 0.26]), colour, 1.8);
  }
  return lists;
}

// Of an object that the model does not know, "unknown": what it was taken for in the end, where that was right.
function rightAnswer(object) {
  return object.correct && object.estimate ? object.estimate : object.truth;
}

// What each object was taken for by that step: {x, y, z, text, kind}.
function objectLabels(scene, step) {
  if (scene.flight) {
    return scene.flight.objects.map((o, i) => {
      const looks = (o.looks ?? []).filter((look) => stepAt(scene, look.time_s) <= step);
      const estimate = looks.at(-1)?.estimate;
      const last = step >= scene.scans - 1;
      const text = estimate ? words(estimate) : last ? (o.found ? "found, not seen closely" : "not found") : "";
      const kind = !estimate ? "open" : estimate === rightAnswer(o) ? "right" : "wrong";
      return { x: o.x_m, y: o.y_m, z: o.z_m + 0.46, text: text ? `${i + 1} ${text}` : String(i + 1), kind };
    });
  }
  const taken = STEPS[step];
  if (!scene.surfaces || !scene.region || !taken?.estimate) return [];
  const { min, max } = scene.region;
  const target = METRICS.targets?.[(Number(taken.target) || 1) - 1] ?? METRICS;
  const kind = taken.estimate === rightAnswer(target) ? "right" : "wrong";
  const x = target.x_m ?? (min[0] + max[0]) / 2;
  const y = target.y_m ?? (min[1] + max[1]) / 2;
  return [{ x, y, z: max[2] + 0.03, text: words(taken.estimate), kind }];
}

function placeObjectLabels(viewer, project) {
  if (!viewer.layers.objects) return;
  for (const label of objectLabels(viewer.scene, viewer.step)) {
    const at = project(label.x, label.y, label.z);
    if (!at) continue;
    const node = append(viewer.labelLayer, "span", { class: `object ${label.kind}` }, label.text);
    node.style.transform = `translate(${at[0]}px, ${at[1]}px) translate(-50%, -100%)`;
  }
}
