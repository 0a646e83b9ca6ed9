// The points where the hand can grasp the body.

/**
 * Distance of a hold inside the border, relative to the distance to the body's middle, so that it stays in reach despite
 * rounding.
 */
const INSIDE = 1e-4;

/**
 * Returns the point (m) that a hand closing at a point grasps, or null if it is out of reach.
 * @param {Scene} scene @param {Pose} pose of the body @param {Vec} point @param {number} slack tolerance beyond the reach (m)
 * @returns {Vec | null}
 */
export function placeOf({ body, reach }, [x, y, theta], point, slack) {
  const c = Math.cos(theta), s = Math.sin(theta);
  const [dx, dy] = [point[0] - x, point[1] - y];
  const local = /** @type {Vec} */ ([c * dx + s * dy, c * dy - s * dx]);
  const near = nearestOf(body, local);
  const distance = Math.hypot(local[0] - near[0], local[1] - near[1]);
  if (distance <= 0.999 * reach || distance === 0) return point;
  if (distance > reach + slack) return null;
  const share = 1 / body.length;
  const middle = body.reduce((sum, vertex) => [sum[0] + share * vertex[0], sum[1] + share * vertex[1]], [0, 0]);
  const inside = [near[0] + INSIDE * (middle[0] - near[0]), near[1] + INSIDE * (middle[1] - near[1])];
  return [x + c * inside[0] - s * inside[1], y + s * inside[0] + c * inside[1]];
}

/**
 * Returns the point of a convex polygon nearest to another one.
 * @param {Vec[]} body counter-clockwise @param {Vec} point @returns {Vec}
 */
function nearestOf(body, point) {
  let inside = body.length > 2;
  let least = Infinity;
  let best = point;
  body.forEach((a, i) => {
    const b = body[(i + 1) % body.length];
    const ex = b[0] - a[0], ey = b[1] - a[1];
    const rx = point[0] - a[0], ry = point[1] - a[1];
    if (ex * ry - ey * rx < 0) inside = false;
    const along = Math.min(1, Math.max(0, (rx * ex + ry * ey) / (ex * ex + ey * ey || 1)));
    const near = /** @type {Vec} */ ([a[0] + along * ex, a[1] + along * ey]);
    const distance = Math.hypot(point[0] - near[0], point[1] - near[1]);
    if (distance < least) [least, best] = [distance, near];
  });
  return inside ? point : best;
}
