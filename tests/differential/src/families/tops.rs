//! Floors of tiles, posts and pins whose tops are level, or lower by up to a micrometre in the direction of the drag: a level body glides
//! across as over one half-plane.

use crate::case::Case;
use stiction_tests::draw::Draw;
use stiction_tests::obstacles::{Among, Obstacle};
use stiction_tests::{Number, Setup};

/// Tops that differ by less than half of this (L) are one floor: 2^-20, half of what the solver takes for one line.
const ONE_FLOOR: f64 = 1.0 / 1_048_576.0;

/// How the tops of a floor lie.
#[derive(Clone, Copy)]
enum Tops {
    Level,
    /// Up or down by half of [`ONE_FLOOR`].
    Uneven,
    /// Each lower than the one before by up to 1 µm.
    Falling,
}

/// Level tops, and falling ones, in turn.
pub(super) fn tops(seed: u64) -> Option<Case> {
    let tops = [Tops::Level, Tops::Falling][usize::from(seed % 2 == 1)];
    glide(seed, tops)
}

pub(super) fn uneven(seed: u64) -> Option<Case> {
    glide(seed, Tops::Uneven)
}

fn glide(seed: u64, tops: Tops) -> Option<Case> {
    let draw = &mut Draw::new(0x70b5_0000 + seed);
    let wide = 0.1 * draw.power(-0.3, 0.3);
    let high = wide * draw.between(0.1, 0.5);
    let narrow = draw.one(&[0.5, 0.5, 0.4]);
    let corners = [[-0.5, -0.5], [0.5, -0.5], [narrow, 0.5], [-narrow, 0.5]];
    let mu = draw.between(0.1, 0.5);
    let friction = [mu, mu * draw.one(&[1.0, 0.5, 0.8])];
    let stiffness = 500.0 * draw.power(-0.3, 0.3);
    let above = draw.one(&[0.0, 0.05]) * wide;
    let body = Setup::new(&corners.map(|[x, y]: [f64; 2]| [x * wide, y * high]));
    let l = body.size();
    let setup = body
        .at([0.0, 0.5 * high + above, 0.0])
        .held_at([draw.between(-0.05, 0.05) * wide, 0.0])
        .springs(stiffness, stiffness * l * l * draw.power(-1.0, 0.3))
        .weighing(draw.one(&[0.0, 0.0, 0.1]) * stiffness * l);
    let [obstacles, level] = floor(draw, tops, [wide, l], friction);
    let [x, y] = setup.grip();
    let depth = y - above - draw.between(0.02, 0.1) * l;
    let travel = draw.between(0.8, 1.6) * wide;
    let seconds = draw.one(&[0.2, 1.0]);
    let keyframes = vec![
        [0.0, x, y, 0.0],
        [0.1, x, depth, 0.0],
        [0.1 + seconds, x + travel, depth, 0.0],
    ];
    let of = |setup: Setup, obstacles| Some(Among { setup, obstacles });
    let (twin, level) = (
        of(setup.clone().floor(friction), Vec::new()),
        of(setup.clone(), level),
    );
    let case = Case {
        twin,
        level,
        ..Case::along(
            Among { setup, obstacles },
            keyframes,
            draw.one(&[100.0, 1000.0]),
        )
    };
    let case = if draw.below(2) == 0 {
        case
    } else {
        case.mirrored()
    };
    // Weight pulls along -y.
    let turns = draw.below(2) == 1 && case.among.setup.weight == 0.0;
    let angle = if turns { draw.between(-3.1, 3.1) } else { 0.0 };
    Some(turned(case, angle))
}

/// A long tile, up to five tiles, posts or pins, and a long tile; and with tops at the same height if they are one floor.
fn floor(
    draw: &mut Draw,
    tops: Tops,
    [wide, l]: [f64; 2],
    friction: [f64; 2],
) -> [Vec<Obstacle>; 2] {
    let mut was_pin = false;
    let deep = -0.5 * wide;
    let mut end = draw.between(0.2, 0.6) * wide;
    let mut top = 0.0;
    let tile = |left: f64, right: f64, top: f64| {
        vec![[left, deep], [right, deep], [right, top], [left, top]]
    };
    let mut all = vec![tile(-2.0 * wide, end, top)];
    let count = draw.below(6);
    for i in 0..=count {
        top = match tops {
            Tops::Level => 0.0,
            Tops::Uneven => draw.between(-0.5, 0.5) * ONE_FLOOR * l,
            Tops::Falling => top - draw.between(0.0, 1e-6),
        };
        // A gap, a seam, or an overlap.
        let gap = match draw.below(8) {
            0 => 0.0,
            1 if !was_pin => -draw.between(0.01, 0.05) * wide,
            _ => draw.power(-6.0, -0.8) * wide,
        };
        let left = end + gap;
        let right = match draw.below(4) {
            _ if i == count => left + 4.0 * wide,
            0 => left,
            1 => left + draw.between(0.02, 0.05) * wide,
            _ => left + draw.between(0.06, 0.4) * wide,
        };
        // A pin inside the tile before it is none, nor is one inside the tile after it.
        let is_pin = right == left;
        was_pin = is_pin;
        let left = if is_pin {
            left.max(end + 1e-3 * wide)
        } else {
            left
        };
        end = if is_pin { left } else { right };
        all.push(if is_pin {
            vec![[left, top]]
        } else {
            tile(left, right, top)
        });
    }
    let obstacle = |vertices| Obstacle { vertices, friction };
    let obstacles: Vec<_> = all.into_iter().map(obstacle).collect();
    let mut level = obstacles.clone();
    if matches!(tops, Tops::Uneven) {
        let points = level.iter_mut().flat_map(|o| &mut o.vertices);
        points.filter(|at| at[1] > deep).for_each(|at| at[1] = 0.0);
    }
    [obstacles, level]
}

/// The whole case turned about the origin, in numbers that are exact in f32 unless it is not turned.
fn turned(mut case: Case, angle: f64) -> Case {
    let (sin, cos) = angle.sin_cos();
    let point = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let pose = |[x, y, phi]: [f64; 3]| {
        let [x, y] = point([x, y]);
        [x, y, phi + angle]
    };
    for Among { setup, obstacles } in [
        Some(&mut case.among),
        case.twin.as_mut(),
        case.level.as_mut(),
    ]
    .into_iter()
    .flatten()
    {
        setup.start = pose(setup.start);
        for surface in &mut setup.surfaces {
            surface.normal = point(surface.normal);
        }
        for at in obstacles.iter_mut().flat_map(|o| &mut o.vertices) {
            *at = point(*at);
        }
    }
    for hand in &mut case.hands {
        *hand = pose(*hand).map(f32::rounded);
    }
    case.keyframes.clear();
    case
}
