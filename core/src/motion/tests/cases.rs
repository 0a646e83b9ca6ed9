//! What holds on every motion, with a foot that stays and with one that glides.

use super::*;

/// M of the hand at the part tau of its way is zero: H = tau D, with the second harmonic of a lever (a, o):
/// (1 - cos 2ϑ) P + sin 2ϑ Q, Q = (a² - o²) / 2, P = -a o.
pub(super) fn curve_is_in_balance<B: Bend<f64>>(random: &mut Random) {
    let (k, hold, drive, dphi) = (
        random.number().abs(),
        random.numbers(),
        random.numbers(),
        random.number(),
    );
    let (along, off) = (random.number(), random.number());
    let bend = B::gliding((along, off));
    let glides = bend != B::NONE;
    let moment = Moment {
        couple: random.number(),
        stiffness: k,
        hold,
        bend,
        tolerance: 0.0,
    };
    let motion = Motion::balanced(&moment, drive, dphi);
    for x in [0.0, 1e-3, 0.1, 0.7] {
        let p = motion.at(x);
        let (sin, cos) = libm::sincos(p.turn);
        let (sin2, cos2) = libm::sincos(2.0 * p.turn);
        let first = k * p.turn + (1.0 - cos) * hold.y + sin * hold.x;
        let second = -along * off * (1.0 - cos2) + (along * along - off * off) / 2.0 * sin2;
        let h = if glides { first + second } else { first };
        let d = k * dphi + cos * drive.y - sin * drive.x;
        let size = k * p.turn.abs() + (hold.reach() + along * along + off * off) * p.turn.abs();
        close(p.part() * d, h, size);
        assert_eq!(p.x, x);
    }
    assert_eq!(motion.direction(), (k * dphi + drive.y).sign());
    assert_eq!(motion.to_within(0.0, 1.0).tolerance, 0.0);
    // Of the way of a point that is moved by 3 at tau = 1, and of the angle.
    let x = motion.to_within(0.01, 3.0).tolerance;
    let swiftest = largest(|x| motion.at(x).h_slope, (0.0, 7.0 / motion.rate.abs()));
    assert!(x * (3.0 * swiftest).max(1.0) <= 0.01 * (1.0 + 1e-9));
    assert!(x * (3.0 * swiftest).max(1.0) >= 0.01 / 2.5);
}

pub(super) fn slopes_are_derivatives<B: Bend<f64>>(random: &mut Random) {
    let motion = random.motion::<B>();
    for x in [0.0, 0.2, 0.9] {
        let p = motion.at(x);
        let [h_slope, h_second] = derivatives(|x| motion.at(x).h, x);
        let [d_slope, d_second] = derivatives(|x| motion.at(x).d, x);
        let size = motion.whole();
        close(p.h_slope, h_slope, size);
        close(p.d_slope, d_slope, size);
        let (h2, d2) = motion.second(&p);
        close(h2, h_second, size);
        close(d2, d_second, size);
        let [h3, d3] = [
            derivatives(|x| motion.second(&motion.at(x)).0, x)[0],
            derivatives(|x| motion.second(&motion.at(x)).1, x)[0],
        ];
        let rate = motion.rate.abs();
        assert!(h3.abs() <= rate * rate * motion.bend.bound(motion.hold.reach(), 3) + 1e-5);
        assert!(d3.abs() <= rate * rate * motion.drive.reach() + 1e-5);
    }
}

/// dtau/dx D², its slope, and a bound of its curvature as far as the window while H < D.
pub(super) fn fold_is_where_the_part_stops_growing<B: Bend<f64>>(random: &mut Random) {
    let motion = random.motion::<B>();
    let [h, d] = turns(&motion);
    for (x, window) in WINDOWS {
        let p = motion.at(x);
        let fold = motion.fold(&p, window);
        let size = motion.whole() * (p.d.abs() + p.h.abs());
        close(
            fold.value,
            derivatives(|x| motion.at(x).h, x)[0] * p.d - p.h * p.d_slope,
            size,
        );
        close(
            fold.slope,
            derivatives(|x| motion.fold(&motion.at(x), window).value, x)[0],
            size,
        );
        let second = |x: f64| {
            let p = motion.at(x);
            if p.h.abs() > p.d.abs() {
                return 0.0;
            }
            derivatives(|x| motion.fold(&motion.at(x), window).slope, x)[0]
        };
        let most = p.d.abs() + window * d[0];
        let terms = h[2] * most + h[1] * d[0] + h[0] * d[1] + most * d[2];
        bounds(fold.curvature, largest(second, (x, x + window)), terms);
    }
}

/// E = start + along tau - u (1 - cos ϑ) + v sin ϑ, times D; of sums of margins, too.
pub(super) fn margin_is_bounded<B: Bend<f64>>(random: &mut Random) {
    let motion = random.motion::<B>();
    let (one, other) = (random.margin(), random.margin());
    let (a, b) = (random.number(), random.number());
    let margin = one.combine(a, other, b);
    close(margin.rounding, 1e-15 * (a.abs() + b.abs()), 0.0);
    let [h, d] = turns(&motion);
    let size = margin.start.abs() + margin.along.abs() + margin.turning.reach();
    for (x, window) in WINDOWS {
        let p = motion.at(x);
        let e = level(&margin, &p, p.part());
        let parts = a * level(&one, &p, p.part()) + b * level(&other, &p, p.part());
        let largest_part = size * (1.0 + p.part().abs());
        close(e, parts, largest_part);
        let bow = motion.bow(&margin);
        let slope = |x: f64| motion.slope(&margin, &motion.at(x), (&bow, window));
        let found = slope(x);
        let whole = largest_part * (p.d.abs() + motion.whole());
        close(found.value, e * p.d, whole);
        close(found.slope, derivatives(|x| slope(x).value, x)[0], whole);
        let second = largest(|at| derivatives(|x| slope(x).slope, at)[0], (x, x + window));
        // The derivatives of the part without tau.
        let rate = motion.rate.abs();
        let swing = rate * margin.turning.length();
        let d_most = p.d.abs() + window * d[0];
        let e_most = level(&margin, &p, 0.0).abs() + window * swing;
        let terms =
            rate * swing * d_most + 2.0 * swing * d[0] + e_most * d[1] + margin.along.abs() * h[1];
        bounds(found.curvature, second, terms);
        // The same in other units.
        let scaled = margin.scaled();
        let unit = margin.start / scaled.start;
        close(level(&scaled, &p, p.part()) * unit, e, largest_part);
        let most = scaled.start.abs().max(scaled.along.abs());
        let most = most.max(scaled.turning.reach());
        assert!((0.5..=2.0).contains(&most), "{most}");
    }
}

/// To tau = 1 or to the fold, and with a margin to its first zero, whichever way it is looked for: all found by small steps.
pub(super) fn course_ends_at_its_first_event<B: Bend<f64>>(random: &mut Random) {
    let motion = random.motion::<B>();
    if motion.at(0.0).h_slope <= 0.0 {
        return;
    }
    let margin = Margin {
        start: random.number().abs(),
        ..random.margin()
    };
    let grows = |x: f64| {
        let p = motion.at(x);
        p.h_slope * p.d - p.h * p.d_slope
    };
    let left = |p: &Place<f64>| level(&margin, p, p.part());
    let course = motion.course();
    assert!(!course.unsure);
    let end = course.end.x;
    if course.folds {
        close(grows(end), 0.0, motion.whole());
        assert!(course.end.part() < 1.0);
    } else {
        close(course.end.part(), 1.0, 0.0);
    }
    let before = |to: f64| (0..500).map(move |i| motion.at(to * f64::from(i) / 500.0));
    assert!(before(end).all(|p| grows(p.x) > 0.0 && p.part() < 1.0));
    let mut stopped = course;
    let stops = motion.stop_at(&margin, &mut stopped);
    let (until, ends) = motion.course_until(Some(&margin));
    assert_eq!(stops, ends);
    close(until.end.x, stopped.end.x, end);
    if stops {
        assert!(stopped.end.x < end && !stopped.folds);
        close(left(&stopped.end), 0.0, 1.0 + margin.along.abs());
    } else {
        assert_eq!((stopped.end.x, stopped.folds), (end, course.folds));
    }
    let size: f64 = margin.start + margin.along.abs() + margin.turning.reach();
    assert!(before(stopped.end.x * (1.0 - 1e-9)).all(|p| left(&p) > 0.0 - size * 1e-9));
}

/// Newton's step with the bend of the moment leaves the third order; next to a fold there is none.
pub(super) fn balance_is_polished_and_bent<B: Bend<f64>>(random: &mut Random) {
    const OFF: f64 = 1e-4;
    let moment = random.moment::<B>();
    let motion = Motion::<f64, B> {
        stiffness: moment.stiffness,
        hold: moment.hold,
        bend: moment.bend,
        ..Motion::kinematic(1.0, Vec2::ZERO)
    };
    // With its couple it is off balance by this at 0.
    let start = moment.now();
    let at = |turn: f64| start - motion.at(turn).h;
    let [slope, second] = derivatives(at, 0.0);
    close(moment.stability(), -slope, motion.whole());
    close(moment.bend.bow(moment.hold.y), -second, motion.whole());
    let bent = largest(
        |turn| derivatives(at, turn)[1],
        (0.0, core::f64::consts::TAU),
    );
    bounds(moment.bent(), bent, bent);
    let off = Moment {
        couple: OFF - start,
        ..moment
    };
    let turn = off.polish();
    let (bend, stability) = (4.0 * off.bent() * OFF, moment.stability());
    if stability <= 0.0 || bend > stability * stability {
        assert_eq!(turn, 0.0);
    } else if bend < 0.04 * stability * stability {
        let left = OFF - motion.at(turn).h;
        let third = motion.bend.bound(motion.hold.reach(), 3) + bent * bent / stability;
        assert!(left.abs() <= third * turn * turn * turn + 1e-15, "{left}");
        assert!(turn > 0.5 * OFF / stability);
    }
}
