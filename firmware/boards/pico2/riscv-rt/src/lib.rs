//! Nothing. A workspace may contain only one version of the start-up code for RISC-V, and the emulated RISC-V uses a different one than
//! rp235x-hal requires; the images for the Pico 2 run on its Arm cores and need none.
#![no_std]
