//! Simulated axis: velocity loop with a time constant, integrator, encoder, drive enable with delay.
//! Runs: cyclic. The discretisation is exact for an input that is constant over the period.

/// Mechanics and velocity loop of one axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Plant {
    /// Position in mm, measured by nobody.
    pub position: f64,
    /// Velocity in mm/s.
    pub velocity: f64,
    time_constant_s: f64,
    decay: f64,
    dt: f64,
}

impl Plant {
    /// At rest at 0; `time_constant_s` of the velocity loop (0: none), sampled every `dt` seconds.
    pub fn new(time_constant_s: f64, dt: f64) -> Self {
        let decay = if time_constant_s > 0.0 { libm::exp(-dt / time_constant_s) } else { 0.0 };
        Self { position: 0.0, velocity: 0.0, time_constant_s, decay, dt }
    }

    /// One period with the velocity command `u`.
    pub fn step(&mut self, u: f64) {
        let off = self.velocity - u;
        self.position += u * self.dt + off * self.time_constant_s * (1.0 - self.decay);
        self.velocity = u + off * self.decay;
    }

    /// Position as an encoder of this resolution sees it; 0: exact.
    pub fn encoder(&self, resolution_mm: f64) -> f64 {
        if resolution_mm > 0.0 { (self.position / resolution_mm).round() * resolution_mm } else { self.position }
    }
}

/// Power stage of a drive.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PowerStage {
    delay_s: f64,
    waited_s: f64,
    on: bool,
    fault: bool,
}

impl PowerStage {
    /// Off; needs `delay_s` to come on.
    pub fn new(delay_s: f64) -> Self {
        Self { delay_s, waited_s: 0.0, on: false, fault: false }
    }
    /// One period of `dt` seconds with this request.
    pub fn step(&mut self, enable: bool, dt: f64) {
        self.waited_s = if enable && !self.fault { self.waited_s + dt } else { 0.0 };
        self.on = enable && !self.fault && self.waited_s >= self.delay_s - 0.5 * dt;
    }
    /// The stage has power.
    pub fn is_on(&self) -> bool {
        self.on
    }
    /// The drive reports a fault.
    pub fn has_fault(&self) -> bool {
        self.fault
    }
    /// Makes or clears a fault: for tests and simulations.
    pub fn set_fault(&mut self, fault: bool) {
        self.fault = fault;
        self.on &= !fault;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn step_response_is_exact() {
        let mut plant = Plant::new(0.005, 0.001);
        (0..20).for_each(|_| plant.step(100.0));
        let t = 0.02;
        assert!((plant.velocity - 100.0 * (1.0 - libm::exp(-t / 0.005))).abs() < 1e-9);
        assert!((plant.position - 100.0 * (t - 0.005 * (1.0 - libm::exp(-t / 0.005)))).abs() < 1e-9);
        assert!((plant.encoder(0.01) - plant.position).abs() <= 0.005 + 1e-12);
    }

    #[test]
    fn power_comes_late_and_goes_at_once() {
        let mut stage = PowerStage::new(0.05);
        (0..49).for_each(|_| stage.step(true, 0.001));
        assert!(!stage.is_on());
        stage.step(true, 0.001);
        assert!(stage.is_on());
        stage.set_fault(true);
        stage.step(true, 0.001);
        assert!(!stage.is_on());
    }
}
