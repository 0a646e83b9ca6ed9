use stiction_core::Evolution;
use stiction_tests::obstacles::Run;
use stiction_tests::obstacles::laws::Laws;
use stiction_tests::obstacles::survey::Kind;
fn main() {
    let a: Vec<usize> = std::env::args()
        .skip(1)
        .map(|a| a.parse().unwrap())
        .collect();
    let world = Kind::Worlds.scene::<f64>(a[0] as u64);
    let laws = Laws::new::<f64>(&world.among);
    println!("{:#?}", world.among);
    let hands = world.hands();
    let mut run = Run::<f64>::start(
        &world.among,
        if a.len() > 3 {
            Evolution::Frame
        } else {
            Evolution::Path
        },
        hands[0],
    );
    for (i, &hand) in hands.iter().enumerate() {
        if i > 0 {
            run.step(hand);
        }
        if i >= a[1] && i <= a[2] {
            let f = &run.frame;
            println!(
                "{i} hand {hand:?} pose {:?} {} {} slips {} events {:?}",
                f.pose,
                f.state.name(),
                f.status.name(),
                f.slips,
                f.events
            );
            for c in &f.contacts {
                println!(
                    "    {:?} at {:?} N {:.5e} T {:.5e} {:?}",
                    c.touch, c.point, c.normal, c.friction, c.sliding
                );
            }
            for b in laws.broken_in(world.room.as_deref(), f) {
                println!("   !! {b:?}");
            }
        }
    }
}
