//! The tasks of a board.

/// The RTIC program of a [`Board`](crate::Board): the path of its chip, and which interrupt starts which task at which priority. The line comes
/// first, since bytes wait for a short time only, then the tick, then the turn, by an interrupt that nothing else uses.
///
/// ```text
/// serial  bytes in and out, by bounded queues
/// tick    hand measured -> safety -> force
/// turn    bytes -> samples, commands -> solver -> demand of a force, reports -> bytes
/// usb     packets in and out, by bounded queues; the computer waits during a turn
/// idle    logs
/// ```
///
/// A board with `usb` uses that line while a program has it open there.
#[macro_export]
macro_rules! app {
    (
        board: $board:ident,
        chip: $($chip:ident)::+,
        serial: $serial:ident at $first:tt,
        tick: $tick:ident at $second:tt,
        turn: $turn:ident at $third:tt,
        $($usb:ident: $packets:ident at $last:tt,)?
    ) => {
        /// For `stop`, which does not know the board.
        #[unsafe(no_mangle)]
        fn stiction_actuators_off() {
            <$board as $crate::Board>::actuators_off();
        }

        #[rtic::app(device = $($chip)::+, peripherals = true)]
        mod app {
            use $($chip)::+::Interrupt;
            use super::$board;
            use $crate::stiction_firmware::device::Servo;
            use $crate::stiction_firmware::line::Line;
            use $crate::stiction_firmware::station::Setup;
            use $crate::work::{self, Work};
            use $crate::{Board, Port};
            $(use $crate::raspberry::$usb;)?

            static SETUP: Setup = $board::SETUP;
            static LINE: Line<{ $board::ROOM }> = Line::new();

            type Clock = <$board as Board>::Clock;
            type Device = <$board as Board>::Device;
            type Memory = <$board as Board>::Memory;
            type Uart = <$board as Board>::Uart;
            type Watchdog = <$board as Board>::Watchdog;

            #[shared]
            struct Shared {
                clock: Clock,
                servo: Servo<Device>,
            }

            #[local]
            struct Local {
                uart: Uart,
                $($usb: $usb::Usb,)?
                work: Work<Watchdog>,
            }

            #[init(local = [memory: Memory = $board::MEMORY])]
            fn init(cx: init::Context) -> (Shared, Local) {
                let program = work::program($board::setup(&SETUP));
                let parts = $board::start(cx.device, cx.core, cx.local.memory);
                let shared = Shared {
                    clock: parts.clock,
                    servo: Servo::new(parts.device),
                };
                let local = Local {
                    uart: parts.uart,
                    $($usb: parts.$usb,)?
                    work: Work {
                        program,
                        watchdog: parts.watchdog,
                    },
                };
                (shared, local)
            }

            #[task(binds = $serial, priority = $first, local = [uart])]
            fn serial(cx: serial::Context) {
                cx.local.uart.serve(&LINE);
            }

            #[task(binds = $tick, priority = $second, shared = [clock, servo])]
            fn tick(cx: tick::Context) {
                work::tick(cx.shared.clock, cx.shared.servo);
                rtic::pend(Interrupt::$turn);
            }

            #[task(binds = $turn, priority = $third, shared = [clock, servo], local = [work])]
            fn turn(cx: turn::Context) {
                let turn::SharedResources { clock, servo, .. } = cx.shared;
                let (line, wake): (_, fn()) = (&LINE, || rtic::pend(Interrupt::$serial));
                $(
                    let (line, wake): (_, fn()) = match $usb::is_open() {
                        true => (&$usb::LINE, || rtic::pend(Interrupt::$packets)),
                        false => (line, wake),
                    };
                )?
                let work = cx.local.work;
                work.turn(clock, servo, line, wake);
                if let Some(numbers) = work.program.restarts_with() {
                    $board::restart_with(numbers, &mut work.watchdog);
                }
            }

            $(
                #[task(binds = $packets, priority = $last, local = [$usb])]
                fn packets(cx: packets::Context) {
                    cx.local.$usb.serve(&$usb::LINE);
                }
            )?

            #[idle]
            fn idle(_: idle::Context) -> ! {
                let lost = || LINE.lost();
                $(let lost = || lost().saturating_add($usb::LINE.lost());)?
                work::log(&SETUP, lost, $board::rest)
            }
        }
    };
}
