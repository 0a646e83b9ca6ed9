use stiction_core::Evolution;
use stiction_tests::obstacles::Run;
use stiction_tests::obstacles::floors::Floor;
use stiction_tests::obstacles::laws::Laws;
fn main() {
    let a: Vec<usize> = std::env::args()
        .skip(1)
        .map(|a| a.parse().unwrap())
        .collect();
    let floor = Floor::of_blocks(a[0] as u64);
    let laws = Laws::new::<stiction_core::Fixed>(&floor.among);
    println!("{:?} {:?}", floor.among.setup, floor.among.obstacles);
    let mut run = Run::<stiction_core::Fixed>::start(&floor.among, Evolution::Path, floor.hands[0]);
    for (i, &hand) in floor.hands.iter().enumerate() {
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
                    "    {:?} dir {:?} at {:?} N {:.5e} T {:.5e} {:?}",
                    c.touch, c.direction, c.point, c.normal, c.friction, c.sliding
                );
            }
            for b in laws.broken(f) {
                println!("   !! {b:?}");
            }
        }
    }
}
