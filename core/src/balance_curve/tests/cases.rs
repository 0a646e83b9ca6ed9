//! Properties of every motion, with a foot that stays and with one that slides.

use super::*;

/// M is zero with the hand at the fraction tau of its path: H = tau D. The lever (a, o) of a sliding foot, as it turns, contributes the
/// change of o (a cos lambda + o sin lambda), the arm of the reaction times its height.
pub(super) fn curve_is_in_balance<H: SecondHarmonic<f64>>(random: &mut Random) {
    let (k, hold, drive, dphi) = (
        random.number().abs(),
        random.numbers(),
        random.numbers(),
        random.number(),
    );
    let (along, off) = (random.number(), random.number());
    let (edge_cos, edge_sin) = random.edge();
    let harmonic = H::sliding((along, off), (edge_cos, edge_sin));
    let slides = harmonic != H::NONE;
    let moment = Moment {
        couple: random.number(),
        stiffness: k,
        hold,
        harmonic,
    };
    let drives = Drive {
        couple: k * dphi,
        hold: drive,
    };
    let curve = BalanceCurve::balanced(&moment, &drives);
    for x in [0.0, 1e-3, 0.1, 0.7] {
        let p = curve.at(x);
        let (sin, cos) = libm::sincos(p.turn);
        let arm = |along: f64, off: f64| off * (along * edge_cos + off * edge_sin);
        let first = k * p.turn + (1.0 - cos) * hold.y + sin * hold.x;
        let turned = (along * cos - off * sin, off * cos + along * sin);
        let second = arm(turned.0, turned.1) - arm(along, off);
        let h = if slides { first + second } else { first };
        let d = k * dphi + cos * drive.y - sin * drive.x;
        let size =
            k * p.turn.abs() + (hold.length_bound() + along * along + off * off) * p.turn.abs();
        close(p.part() * d, h, size);
        assert_eq!(p.x, x);
    }
    assert_eq!(curve.direction(), (k * dphi + drive.y).sign());
}

pub(super) fn slopes_are_derivatives<H: SecondHarmonic<f64>>(random: &mut Random) {
    let curve = random.curve::<H>();
    for x in [0.0, 0.2, 0.9] {
        let p = curve.at(x);
        let [h_slope, h_second] = derivatives(|x| curve.at(x).h, x);
        let [d_slope, d_second] = derivatives(|x| curve.at(x).d, x);
        let size = curve.whole();
        close(p.h_slope, h_slope, size);
        close(p.d_slope, d_slope, size);
        let (h2, d2) = curve.second(&p);
        close(h2, h_second, size);
        close(d2, d_second, size);
        let [h3, d3] = [
            derivatives(|x| curve.second(&curve.at(x)).0, x)[0],
            derivatives(|x| curve.second(&curve.at(x)).1, x)[0],
        ];
        let rate = curve.rate.abs();
        assert!(
            h3.abs() <= rate * rate * curve.harmonic.bound(curve.hold.length_bound(), 3) + 1e-5
        );
        assert!(d3.abs() <= rate * rate * curve.drive.length_bound() + 1e-5);
    }
}

/// dtau/dx D², its slope, and a bound of its curvature up to the window while H < D.
pub(super) fn fold_is_where_the_part_stops_growing<H: SecondHarmonic<f64>>(random: &mut Random) {
    let curve = random.curve::<H>();
    let [h, d] = turns(&curve);
    for (x, window) in WINDOWS {
        let p = curve.at(x);
        let fold = curve.fold(&p, window);
        let size = curve.whole() * (p.d.abs() + p.h.abs());
        close(
            fold.value,
            derivatives(|x| curve.at(x).h, x)[0] * p.d - p.h * p.d_slope,
            size,
        );
        close(
            fold.slope,
            derivatives(|x| curve.fold(&curve.at(x), window).value, x)[0],
            size,
        );
        let second = |x: f64| {
            let p = curve.at(x);
            if p.h.abs() > p.d.abs() {
                return 0.0;
            }
            derivatives(|x| curve.fold(&curve.at(x), window).slope, x)[0]
        };
        let most = p.d.abs() + window * d[0];
        let terms = h[2] * most + h[1] * d[0] + h[0] * d[1] + most * d[2];
        bounds(fold.curvature, largest(second, (x, x + window)), terms);
    }
}

/// E = start + along tau - u (1 - cos ϑ) + v sin ϑ, times D; also for sums of margins.
pub(super) fn margin_is_bounded<H: SecondHarmonic<f64>>(random: &mut Random) {
    let curve = random.curve::<H>();
    let (one, other) = (random.margin(), random.margin());
    let (a, b) = (random.number(), random.number());
    let margin = one.combine(a, other, b);
    close(margin.rounding, 1e-15 * (a.abs() + b.abs()), 0.0);
    let [h, d] = turns(&curve);
    let size = margin.start.abs() + margin.along.abs() + margin.turning.length_bound();
    for (x, window) in WINDOWS {
        let p = curve.at(x);
        let e = level(&margin, &p, p.part());
        let parts = a * level(&one, &p, p.part()) + b * level(&other, &p, p.part());
        let largest_part = size * (1.0 + p.part().abs());
        close(e, parts, largest_part);
        let curvature_bound = curve.curvature_bound(&margin);
        let slope = |x: f64| curve.slope(&margin, &curve.at(x), (&curvature_bound, window));
        let found = slope(x);
        let whole = largest_part * (p.d.abs() + curve.whole());
        close(found.value, e * p.d, whole);
        close(found.slope, derivatives(|x| slope(x).value, x)[0], whole);
        let second = largest(|at| derivatives(|x| slope(x).slope, at)[0], (x, x + window));
        // The derivatives of the term without tau.
        let rate = curve.rate.abs();
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
        let most = most.max(scaled.turning.length_bound());
        assert!((0.5..=2.0).contains(&most), "{most}");
    }
}

/// To tau = 1 or to the fold, and with a margin to its first zero, whichever search finds it: all compared with small steps.
pub(super) fn extent_ends_at_its_first_event<H: SecondHarmonic<f64>>(random: &mut Random) {
    let curve = random.curve::<H>();
    if curve.at(0.0).h_slope <= 0.0 {
        return;
    }
    let margin = Margin {
        start: random.number().abs(),
        ..random.margin()
    };
    let grows = |x: f64| {
        let p = curve.at(x);
        p.h_slope * p.d - p.h * p.d_slope
    };
    let left = |p: &Place<f64>| level(&margin, p, p.part());
    let extent = curve.extent();
    assert!(!extent.unsure);
    let end = extent.end.x;
    if extent.folds {
        close(grows(end), 0.0, curve.whole());
        assert!(extent.end.part() < 1.0);
    } else {
        close(extent.end.part(), 1.0, 0.0);
    }
    let before = |to: f64| (0..500).map(move |i| curve.at(to * f64::from(i) / 500.0));
    assert!(before(end).all(|p| grows(p.x) > 0.0 && p.part() < 1.0));
    let mut stopped = extent;
    let stops = curve.stop_at(&margin, &mut stopped);
    let (until, ends) = curve.extent_until(Some(&margin));
    assert_eq!(stops, ends);
    close(until.end.x, stopped.end.x, end);
    if stops {
        assert!(stopped.end.x < end && !stopped.folds);
        close(left(&stopped.end), 0.0, 1.0 + margin.along.abs());
    } else {
        assert_eq!((stopped.end.x, stopped.folds), (end, extent.folds));
    }
    let size: f64 = margin.start + margin.along.abs() + margin.turning.length_bound();
    assert!(before(stopped.end.x * (1.0 - 1e-9)).all(|p| left(&p) > 0.0 - size * 1e-9));
}

/// Newton's step with the curvature of the moment leaves an error of third order; near a fold there is no such step.
pub(super) fn balance_is_polished_and_curved<H: SecondHarmonic<f64>>(random: &mut Random) {
    const OFF: f64 = 1e-4;
    let moment = random.moment::<H>();
    let curve = BalanceCurve::<f64, H> {
        stiffness: moment.stiffness,
        hold: moment.hold,
        harmonic: moment.harmonic,
        ..BalanceCurve::kinematic(1.0, Vec2::ZERO)
    };
    // With its couple it is out of balance by this at 0.
    let start = moment.now();
    let at = |turn: f64| start - curve.at(turn).h;
    let [slope, second] = derivatives(at, 0.0);
    close(moment.stability(), -slope, curve.whole());
    close(
        moment.harmonic.stiffening(moment.hold.y),
        -second,
        curve.whole(),
    );
    let curvature = largest(
        |turn| derivatives(at, turn)[1],
        (0.0, core::f64::consts::TAU),
    );
    bounds(moment.curvature_bound(), curvature, curvature);
    let off = Moment {
        couple: OFF - start,
        ..moment
    };
    let turn = off.polish();
    let (kantorovich, stability) = (4.0 * off.curvature_bound() * OFF, moment.stability());
    if stability <= 0.0 || kantorovich > stability * stability {
        assert_eq!(turn, 0.0);
    } else if kantorovich < 0.04 * stability * stability {
        let left = OFF - curve.at(turn).h;
        let third =
            curve.harmonic.bound(curve.hold.length_bound(), 3) + curvature * curvature / stability;
        assert!(left.abs() <= third * turn * turn * turn + 1e-15, "{left}");
        assert!(turn > 0.5 * OFF / stability);
    }
}
