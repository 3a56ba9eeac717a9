// Points of a Campbell diagram: a branch and the index of one of its speeds.

const NEAR_PX = 14;

// Returns the point nearest to the pointer, or null if no branch is near enough.
export function nearest(report, chart, pointer, near_px = NEAR_PX) {
  let best = null;
  let least = near_px;
  for (const branch of report.campbell.branches) {
    /** @returns {[number, number]} */
    const at = (i) => [chart.valToPos(branch.rpm[i], "x"), chart.valToPos(branch.frequency_hz[i], "y")];
    branch.rpm.forEach((_, i) => {
      const [here, isLast] = [at(i), i + 1 === branch.rpm.length];
      const distance = isLast ? Math.hypot(pointer[0] - here[0], pointer[1] - here[1]) : toSegment(pointer, here, at(i + 1));
      if (distance >= least) return;
      least = distance;
      // Between two samples, the one with the nearer speed is taken.
      const next = !isLast && pointer[0] - here[0] > at(i + 1)[0] - pointer[0];
      best = { branch, i: next ? i + 1 : i };
    });
  }
  return best;
}

// Moves a point along its branch, or to the branch above or below at the same speed.
export function walked(report, { branch, i }, [along, up]) {
  const { branches } = report.campbell;
  if (along !== 0) return { branch, i: Math.min(Math.max(i + along, 0), branch.rpm.length - 1) };
  const here = branches
    .map((other) => ({ branch: other, i: other.rpm.indexOf(branch.rpm[i]) }))
    .filter((at) => at.i >= 0)
    .sort((a, b) => a.branch.frequency_hz[a.i] - b.branch.frequency_hz[b.i]);
  const place = here.findIndex((at) => at.branch === branch);
  return here[Math.min(Math.max(place + up, 0), here.length - 1)];
}

// Finds a point again in the report of a changed saw: the branch of equal name, and of equal number if there are
// several, at the nearest speed. Returns null if no branch has this name.
export function samePoint(report, { branch, i }) {
  const alike = report.campbell.branches.filter(({ name }) => name === branch.name);
  const found = alike.find((other) => other.branch === branch.branch) ?? alike[0];
  if (!found) return null;
  const off = found.rpm.map((rpm) => Math.abs(rpm - branch.rpm[i]));
  return { branch: found, i: off.indexOf(Math.min(...off)) };
}

// Returns the distance of a point from the straight line between two others.
export function toSegment([px, py], [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const length = dx * dx + dy * dy;
  const t = length > 0 ? Math.min(Math.max(((px - ax) * dx + (py - ay) * dy) / length, 0), 1) : 0;
  return Math.hypot(px - ax - t * dx, py - ay - t * dy);
}
