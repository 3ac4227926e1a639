//! One activation of a task: inputs, programs, outputs (IEC 61131-3 reference §10.3); and what a fault does.
//!
//! Runs: cyclic. The time sample is the planned time of the release, so that a late scan computes what it would have computed in
//! time; it never lies before that of an earlier activation.

use crate::clock::{Clock, stopwatch};
use crate::record::FaultRecord;
use crate::resource::{OnFault, Resource, ScanInfo, State};
use takt_base::Nanos;
use takt_image::Fault;

impl Resource {
    /// Runs a task that is ready.
    pub(crate) fn scan(&mut self, task: usize, clock: &dyn Clock) -> ScanInfo {
        let start = clock.now();
        let release = self.tasks[task].take(start);
        let now = release.max(self.counts.now);
        self.counts.now = now;
        self.counts.scans += 1;
        self.read_inputs(now, self.counts.scans);
        let watch = self.options.measure.then(stopwatch);
        let result = self.run_programs(task, now);
        let took = watch.map(|w| stopwatch() - w);
        let fault = result
            .err()
            .map(|(program, fault)| self.fault(FaultRecord { fault, task, program, scan: self.counts.scans, time: now }));
        self.write_outputs(task, now);
        self.account(task, start - release, took, clock.now());
        ScanInfo { task, scan: self.counts.scans, now, fault }
    }

    /// Inputs in, then what the simulation sets, for the scan of this number.
    pub(crate) fn read_inputs(&mut self, now: Nanos, scan: u64) {
        self.driver.read_inputs(now, scan, &mut self.memory[self.image.memory.inputs.range()]);
        self.driver.force(now, scan, &mut self.memory);
    }

    /// The programs in declaration order, to the end or to the first fault.
    fn run_programs(&mut self, task: usize, now: Nanos) -> Result<(), (usize, Fault)> {
        let budget = self.tasks[task].watchdog;
        let now = self.epoch + now;
        for (i, p) in self.image.tasks[task].programs.iter().enumerate() {
            self.engine.run(p.function, p.instance, now, budget, &mut self.memory, &mut *self.host).map_err(|f| (i, f))?;
        }
        Ok(())
    }

    /// Records a fault and stops what the options say.
    fn fault(&mut self, record: FaultRecord) -> FaultRecord {
        if self.faults.len() < self.faults.capacity() {
            self.faults.push(record);
        }
        self.counts.faults += 1;
        let t = &mut self.tasks[record.task];
        t.stats.faults += 1;
        t.stopped = true;
        if self.options.on_fault == OnFault::StopResource || self.tasks.iter().all(|t| t.stopped) {
            self.state = State::Faulted;
        }
        record
    }

    /// Outputs out; those of a stopped task, or all, in their safe state.
    fn write_outputs(&mut self, task: usize, now: Nanos) {
        if self.state == State::Faulted {
            return self.shut_down(now);
        }
        let outputs = &mut self.memory[self.image.memory.outputs.range()];
        if self.options.on_fault == OnFault::StopTask {
            self.safe.note(task, outputs);
            if self.tasks[task].stopped {
                self.safe.release(task, outputs);
            }
        }
        self.driver.write_outputs(now, outputs);
    }

    fn account(&mut self, task: usize, lateness: Nanos, took: Option<Nanos>, end: Nanos) {
        let t = &mut self.tasks[task];
        t.finish(end, self.options.base_tick);
        t.stats.scans += 1;
        t.stats.lateness.record(lateness);
        if let Some(took) = took {
            t.stats.scan_time.record(took);
            self.counts.last_scan = took;
            self.counts.longest_scan = took.max(self.counts.longest_scan);
        }
        self.counts.overruns = self.tasks.iter().map(|t| t.stats.overruns).sum();
    }
}
