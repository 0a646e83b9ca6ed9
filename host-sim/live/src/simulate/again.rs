//! Contacts of a run. Computing them takes longer than the steps and they are not always needed: the run is repeated to compute
//! them on demand.

use stiction_core::{Hand, Model, narrow_hand};
use stiction_scene::{HostSolver, Sample};

use super::{Running, Shared};
use crate::record::{ContactRecord, Frame, rename, set_contacts};

/// The contacts of a run, not yet computed.
pub trait Contacts: Send + Sync {
    /// Passes the contacts of every frame to `take`, in order.
    fn each(&self, take: &mut dyn FnMut(&[ContactRecord]));
}

struct Again<R: Shared, M: Model> {
    start: Running<R, M>,
    hands: Vec<Hand<R::Si>>,
}

impl<R: Shared, M: Model> Contacts for Again<R, M>
where
    HostSolver<R, M>: Send + Sync,
{
    fn each(&self, take: &mut dyn FnMut(&[ContactRecord])) {
        let mut running = self.start.clone();
        let mut contacts = Vec::new();
        for &hand in &self.hands {
            let (solver, state, _) = running.step(hand);
            set_contacts(&mut contacts, solver, state);
            rename(&mut contacts, self.start.indices.as_ref());
            take(&contacts);
        }
    }
}

impl<R: Shared, M: Model> Running<R, M>
where
    HostSolver<R, M>: Send + Sync,
{
    /// Steps through `samples` and passes every frame, without its contacts, to `take`.
    pub(crate) fn without_contacts(
        &mut self,
        samples: &mut dyn Iterator<Item = Sample>,
        take: &mut dyn FnMut(&Frame),
    ) -> Box<dyn Contacts> {
        let start = self.clone();
        let mut hands = Vec::with_capacity(samples.size_hint().0);
        let mut frame = Frame::default();
        for sample in samples {
            let hand = narrow_hand(&sample.hand);
            hands.push(hand);
            let (solver, state, output) = self.step(hand);
            frame = frame.renewed(sample.t, solver, state, &output);
            take(&frame);
        }
        Box::new(Again { start, hands })
    }
}
