//! Nothing. Of the start-up code for RISC-V only one version may be named in a workspace, and the emulated RISC-V has another one than
//! rp235x-hal asks for; the images for the Pico 2 are those of its Arm cores and need none.
#![no_std]
