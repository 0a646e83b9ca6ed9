//! Scenes among obstacles with known answers: sticks, slides and slips about corners, flat contacts, pegs, a wedge, ends of sides, a thin wall.

use stiction_core::Contact;
use stiction_core::{Fixed, Hand, Status};
use stiction_statics::{Output, Solver, State};
use stiction_tests::Number;
use stiction_tests::obstacles::Among;
use stiction_tests::obstacles::cases::{self, Answer, Case};
use stiction_tests::obstacles::scene::{CORNERS, SURFACES, VERTICES};

type Among48<R> = Solver<R, VERTICES, SURFACES, CORNERS>;

struct Run<R: Number> {
    solver: Among48<R>,
    state: State<R>,
    output: Output<R::Si>,
    slips: u32,
}

fn planar<R: Number>([x, y, phi]: [f64; 3]) -> Hand<R::Si> {
    let [x, y, phi] = [x, y, phi].map(R::si);
    Hand::new(x, y, phi)
}

impl<R: Number> Run<R> {
    fn new(among: &Among, hand: [f64; 3]) -> Self {
        let among = among.within::<R>();
        let solver = among.described::<R, _>(|description| Among48::<R>::new(description));
        let solver = solver.expect("a scene");
        let (state, output) = solver.start(planar::<R>(hand));
        Self {
            slips: output.slips,
            solver,
            state,
            output,
        }
    }
    fn to(&mut self, hand: [f64; 3]) {
        self.output = self.solver.step(&mut self.state, planar::<R>(hand));
        self.slips += self.output.slips;
    }
    /// By how much the error of a contact's force can exceed that of the balance: two contacts bear its moment at their distance.
    fn leverage(&self, size: f64) -> f64 {
        let contacts = self.solver.contacts(&self.state);
        let points: Vec<_> = contacts.iter().map(|c| c.point.map(R::wide)).collect();
        match points.as_slice() {
            [[ax, ay], [bx, by]] => 1.0 + size / (bx - ax).hypot(by - ay),
            _ => 1.0,
        }
    }
    fn answer(&self) -> Answer {
        let contacts = self.solver.contacts(&self.state);
        let force = |c: &Contact<R::Si>| (c.touch, [R::wide(c.normal), R::wide(c.friction)]);
        let [x, y] = self.output.position.map(R::wide);
        let [_, pull] = self.solver.wrench(&self.state).force;
        Answer {
            pose: [x, y, R::wide_angle(self.output.angle)],
            contacts: contacts.iter().map(force).collect(),
            pull: R::wide(pull),
            slips: self.slips,
            state: self.output.state.name(),
        }
    }
}

/// A pose is known to so many touches (L, rad): an event to one, what leads to it and from it too, an angle at a lever of L to one more.
const TOUCHES: i32 = 4;

/// Errors relative to the scale of a check: of a pose, and of a force what that is times k_h L.
fn follows<R: Number>(case: &Case) {
    let setup = &case.among.setup;
    let known = R::wide((R::TOUCH * R::from_int(TOUCHES)).to_si(R::si(1.0)));
    let unit = setup.stiffness_translation * setup.size();
    let mut run = Run::<R>::new(&case.among, case.hands[0]);
    for (i, &hand) in case.hands.iter().enumerate() {
        if i > 0 {
            run.to(hand);
        }
        assert_eq!(run.output.status, Status::Ok, "{}: frame {i}", case.name);
        let answer = run.answer();
        for check in case.checks.iter().filter(|check| check.frame == i) {
            let error = check.error(&answer);
            let bound = if check.value.is_pose() {
                known
            } else {
                known * (unit * run.leverage(setup.size()) / check.scale).max(1.0)
            };
            let (name, value) = (&case.name, &check.value);
            assert!(
                error <= bound,
                "{} {name}: frame {i}: {value:?} off by {error:.1e}, allowed {bound:.1e}: {answer:?}",
                R::NAME
            );
        }
    }
}

fn sound() -> impl Iterator<Item = Case> {
    cases::all().into_iter().filter(|case| !case.refused)
}

#[test]
fn known_answers_in_f64() {
    sound().for_each(|case| follows::<f64>(&case));
}

#[test]
fn known_answers_in_f32() {
    sound().for_each(|case| follows::<f32>(&case));
}

#[test]
fn known_answers_in_fixed_point() {
    sound().for_each(|case| follows::<Fixed>(&case));
}

#[test]
fn a_start_inside_an_obstacle_is_refused() {
    for case in cases::all().into_iter().filter(|case| case.refused) {
        let built =
            (case.among).described::<f64, _>(|description| Among48::<f64>::new(description));
        assert!(built.is_err(), "{}", case.name);
    }
}
