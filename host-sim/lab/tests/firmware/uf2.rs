//! A Pico that is flashed with the file of `stiction image` runs its scene. What is in the file is tested with the program.

use crate::chip::PICO;
use stiction_host_sim::firmware::image::parts;
use stiction_host_sim::firmware::uf2::{Family, uf2};
use stiction_lab::pico::{Chip, FLASH, MEGAHERTZ};
use stiction_tests::station::client::{Client, Said};
use stiction_wire::Command;

/// What a boot program writes into a flash of 2 MB: each block of 512 bytes has the address of a page and, behind 32 bytes, the page.
fn written(file: &[u8]) -> Vec<u8> {
    let mut flash = vec![0xFF; 2 << 20];
    for block in file.chunks_exact(512) {
        let at = u32::from_le_bytes(block[12..16].try_into().unwrap());
        flash[(at - FLASH) as usize..][..256].copy_from_slice(&block[32..288]);
    }
    flash
}

#[test]
fn a_pico_that_is_flashed_with_the_file_runs_its_scene() {
    let Some(image) = PICO.image_of(Some("point-stick-slip")) else {
        return;
    };
    let file = uf2(&parts(&image.path).unwrap(), Family::RP2040).unwrap();
    let mut chip = Chip::new(written(&file));
    let mut client = Client::default();
    let ms = u64::from(MEGAHERTZ) * 1_000;
    chip.run(10 * ms);
    chip.bring(&client.encode(Command::Hello));
    chip.run(10 * ms);
    client.listen(&chip.gone());
    let info = client
        .inbox
        .iter()
        .find_map(|received| match &received.said {
            Said::Info(info) => Some(info.clone()),
            _ => None,
        });
    let info = info.expect("it says what it is");
    // A point on a plane, with friction and without weight or obstacles.
    assert_eq!((&*info.name, info.room), ("pico", [1, 1]));
    assert_eq!(info.has, [true, false, false]);
}
