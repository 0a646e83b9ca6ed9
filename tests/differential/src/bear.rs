//! The reactions that bear a load best: for subjects that do not report any.

use crate::case::Case;
use stiction_judge::{Frame, Touch, centroid};

type Wrench = [f64; 3];

/// The frame with the reactions within friction, along -s mu_d where it slides, that leave the least of the load over; and how much that is,
/// relative to k_h L.
pub(crate) fn borne(case: &Case, mut frame: Frame) -> (Frame, f64) {
    let setup = &case.among.setup;
    let (l, unit) = (setup.size(), setup.stiffness_translation * setup.size());
    let place = |point| setup.world(frame.pose, point);
    let grip = place(setup.holding_point.unwrap_or_default());
    let centre = place(centroid(&setup.vertices));
    let wrench = |[x, y]: [f64; 2], [fx, fy]: [f64; 2]| {
        let moment = (x - grip[0]) * fy - (y - grip[1]) * fx;
        [fx / unit, fy / unit, moment / (unit * l)]
    };
    let pull = wrench(centre, [0.0, -setup.weight]);
    let [fx, fy, moment] = frame.wrench;
    let load = [
        fx / unit + pull[0],
        fy / unit + pull[1],
        moment / (unit * l) + pull[2],
    ];
    // The contact, N and T per unit, and the wrench of each edge of a friction cone.
    let mut edges: Vec<(usize, [f64; 2], Wrench)> = Vec::new();
    for (i, contact) in frame.contacts.iter().enumerate() {
        let [mu_s, mu_d] = case.among.friction(contact.touch);
        let Some([nx, ny]) = direction(case, &frame, i) else {
            continue;
        };
        let signs: &[f64] = match contact.sliding {
            Some(1) => &[-mu_d],
            Some(-1) => &[mu_d],
            _ => &[mu_s, -mu_s],
        };
        for &t in signs {
            let force = [nx + t * ny, ny - t * nx].map(|f| f * unit);
            edges.push((i, [1.0, t], wrench(contact.point, force)));
        }
    }
    let (parts, left) = least(&edges.iter().map(|edge| edge.2).collect::<Vec<_>>(), load);
    for contact in &mut frame.contacts {
        (contact.normal, contact.friction) = (0.0, 0.0);
    }
    for (edge, part) in parts {
        let (i, [n, t], _) = edges[edge];
        frame.contacts[i].normal += part * n * unit;
        frame.contacts[i].friction += part * t * unit;
    }
    (frame, left)
}

/// The unit normal of a contact towards the body.
fn direction(case: &Case, frame: &Frame, contact: usize) -> Option<[f64; 2]> {
    let contact = &frame.contacts[contact];
    contact.direction.or_else(|| match contact.touch {
        Touch::Surface { surface, .. } => {
            let [x, y] = case.among.setup.surfaces.get(surface)?.normal;
            Some([x, y].map(|n| n / x.hypot(y)))
        }
        Touch::Side { .. } | Touch::Corner { .. } => None,
    })
}

/// Parts >= 0 of at most three wrenches whose sum is nearest to -load, and what is left.
fn least(edges: &[Wrench], load: Wrench) -> (Vec<(usize, f64)>, f64) {
    let mut best = (Vec::new(), length(load));
    let count = edges.len();
    for i in 0..count {
        for j in i..count {
            for k in j..count {
                let mut set = vec![i, j, k];
                set.dedup();
                let Some((parts, left)) = fitted(edges, &set, load) else {
                    continue;
                };
                if left < best.1 {
                    best = (set.into_iter().zip(parts).collect(), left);
                }
            }
        }
    }
    best
}

/// Least squares over a set, by Gram-Schmidt; `None` if a part is negative or the set is dependent.
fn fitted(edges: &[Wrench], set: &[usize], load: Wrench) -> Option<(Vec<f64>, f64)> {
    let mut bases: Vec<Wrench> = Vec::new();
    let mut upper: Vec<Vec<f64>> = Vec::new();
    for &i in set {
        let mut rest = edges[i];
        let mut row = Vec::new();
        for base in &bases {
            let along = dot(*base, rest);
            rest = [0, 1, 2].map(|k| rest[k] - along * base[k]);
            row.push(along);
        }
        let long = length(rest);
        if long < 1e-9 * length(edges[i]) {
            return None;
        }
        row.push(long);
        bases.push(rest.map(|x| x / long));
        upper.push(row);
    }
    let mut rest = load.map(|x| -x);
    let mut goals = Vec::new();
    for base in &bases {
        let along = dot(*base, rest);
        rest = [0, 1, 2].map(|k| rest[k] - along * base[k]);
        goals.push(along);
    }
    let mut parts = vec![0.0; set.len()];
    for i in (0..set.len()).rev() {
        let known: f64 = (i + 1..set.len()).map(|j| upper[j][i] * parts[j]).sum();
        parts[i] = (goals[i] - known) / upper[i][i];
    }
    (parts.iter().all(|&part| part >= 0.0)).then(|| (parts, length(rest)))
}

fn dot(a: Wrench, b: Wrench) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(a: Wrench) -> f64 {
    dot(a, a).sqrt()
}
