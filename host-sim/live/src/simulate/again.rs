//! Contacts of a run. Computing them takes longer than the steps and they are not always needed: the run is repeated to compute
//! them on demand.

use std::collections::TryReserveError;
use std::ops::ControlFlow;

use stiction_core::{Hand, narrow_hand};
use stiction_scene::{HostSolver, Sample};

use super::{Running, Shared};
use crate::record::{ContactRecord, Frame, rename, set_contacts};

/// The contacts of a run, not yet computed.
pub trait Contacts: Send + Sync {
    /// Passes the contacts of every frame to `take`, in order, until it breaks off.
    fn each(&self, take: &mut dyn FnMut(&[ContactRecord]) -> ControlFlow<()>);
}

struct Again<R: Shared> {
    start: Running<R>,
    hands: Vec<Hand<R::Si>>,
}

impl<R: Shared> Contacts for Again<R>
where
    HostSolver<R>: Send + Sync,
{
    fn each(&self, take: &mut dyn FnMut(&[ContactRecord]) -> ControlFlow<()>) {
        let mut running = self.start.clone();
        let mut contacts = Vec::new();
        for &hand in &self.hands {
            let (solver, state, _) = running.step(hand);
            set_contacts(&mut contacts, solver, state);
            rename(&mut contacts, self.start.indices.as_ref());
            if take(&contacts).is_break() {
                return;
            }
        }
    }
}

impl<R: Shared> Running<R>
where
    HostSolver<R>: Send + Sync,
{
    /// Steps through `samples` and passes every frame, without its contacts, to `take`, until it breaks off.
    ///
    /// # Errors
    /// There is no memory for the hands of the samples.
    pub(crate) fn without_contacts(
        &mut self,
        samples: &mut dyn Iterator<Item = Sample>,
        take: &mut dyn FnMut(&Frame) -> ControlFlow<()>,
    ) -> Result<Box<dyn Contacts>, TryReserveError> {
        let start = self.clone();
        let mut hands = Vec::new();
        hands.try_reserve_exact(samples.size_hint().0)?;
        let mut frame = Frame::default();
        for sample in samples {
            let hand = narrow_hand(&sample.hand);
            hands.push(hand);
            let (solver, state, output) = self.step(hand);
            frame = frame.renewed(sample.t, solver, state, &output);
            if take(&frame).is_break() {
                break;
            }
        }
        Ok(Box::new(Again { start, hands }))
    }
}
