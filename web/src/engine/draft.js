// A model of fewer triangles, to be drawn while it moves. Loaded only when a model is large.
//
// meshoptimizer merges edges by quadric errors (Garland and Heckbert 1997). Each group of a model is simplified by itself,
// with its border kept, so that groups still fit together.

import { MeshoptSimplifier } from 'meshoptimizer/simplifier';

const TRIANGLES = 60000; // that a draft has, about
const LARGEST_ERROR = 0.02; // of the model's size

/** Triangles sorted by group: [group, indices]. */
function byGroup({ indices, groups }) {
  const counts = new Map();
  for (const g of groups) counts.set(g, (counts.get(g) ?? 0) + 1);
  if (counts.size < 2) return [[groups[0] ?? 0, indices]];
  const parts = new Map([...counts].map(([g, n]) => [g, { indices: new Uint32Array(3 * n), used: 0 }]));
  for (let t = 0; t < groups.length; t++) {
    const part = parts.get(groups[t]);
    for (let k = 0; k < 3; k++) part.indices[part.used++] = indices[3 * t + k];
  }
  return [...parts].map(([g, part]) => [g, part.indices]);
}

/** Vertices that triangles use, and no others; changes `indices`. */
function compact(positions, indices) {
  const [remap, count] = MeshoptSimplifier.compactMesh(indices), out = new Float32Array(3 * count);
  for (let v = 0; v < remap.length; v++) {
    if (remap[v] === 0xffffffff) continue;
    for (let k = 0; k < 3; k++) out[3 * remap[v] + k] = positions[3 * v + k];
  }
  return out;
}

/** Infinite and absent numbers would spoil all others: their triangles are left out. */
function finite({ positions, indices, groups }) {
  if (positions.every(Number.isFinite)) return { positions, indices, groups };
  const good = (t) => [0, 1, 2].every((k) => [0, 1, 2].every((c) => Number.isFinite(positions[3 * indices[3 * t + k] + c])));
  const kept = Array.from(groups.keys()).filter(good);
  return {
    positions: positions.map((x) => (Number.isFinite(x) ? x : 0)),
    indices: Uint32Array.from(kept.flatMap((t) => [...indices.subarray(3 * t, 3 * t + 3)])),
    groups: Uint16Array.from(kept, (t) => groups[t]),
  };
}

/** @param {{positions: Float32Array, indices: Uint32Array, groups: Uint16Array}} mesh its vertices may lie there many times */
export async function simplify(mesh) {
  await MeshoptSimplifier.ready;
  const { positions, indices, groups } = finite(mesh);
  const weld = MeshoptSimplifier.generatePositionRemap(positions, 3);
  for (let k = 0; k < indices.length; k++) indices[k] = weld[indices[k]];
  const parts = byGroup({ indices, groups }), share = TRIANGLES / (indices.length / 3);
  const flags = parts.length > 1 ? ['LockBorder', 'Sparse'] : [];
  const made = parts.map(([group, part]) => {
    const wanted = 3 * Math.ceil((part.length / 3) * Math.min(share, 1));
    return [group, MeshoptSimplifier.simplify(part, positions, 3, wanted, LARGEST_ERROR, flags)[0]];
  });
  const total = made.reduce((sum, [, part]) => sum + part.length, 0);
  const out = { indices: new Uint32Array(total), groups: new Uint16Array(total / 3) };
  let at = 0;
  for (const [group, part] of made) {
    out.indices.set(part, at);
    out.groups.fill(group, at / 3, (at + part.length) / 3);
    at += part.length;
  }
  return { ...out, positions: compact(positions, out.indices) };
}
