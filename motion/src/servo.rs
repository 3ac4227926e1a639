//! Position loop of one axis: PID with velocity and acceleration feed-forward, output clamp and anti-windup.
//! Runs: cyclic, once a servo period. From: R1-170..R1-172, R1-185, R1-199; derivative on the error, which never steps here because
//! set points are continuous.

/// Gains. Output is a velocity command in mm/s.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Gains {
    /// Proportional, 1/s.
    pub kp: f64,
    /// Integral, 1/s2.
    pub ki: f64,
    /// Derivative, no unit.
    pub kd: f64,
    /// Share of the set velocity.
    pub kff_velocity: f64,
    /// Seconds of set acceleration.
    pub kff_acceleration: f64,
    /// Clamp of the output, mm/s.
    pub output_max: f64,
}

/// What the loop follows: position, velocity and acceleration of the set point.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct SetPoint {
    /// mm
    pub position: f64,
    /// mm/s
    pub velocity: f64,
    /// mm/s2
    pub acceleration: f64,
}

/// State of the loop.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Servo {
    integral: f64,
    error: f64,
}

impl Servo {
    /// Velocity command for the next period of `dt` seconds.
    pub fn step(&mut self, gains: &Gains, set: &SetPoint, actual: f64, dt: f64) -> f64 {
        let error = set.position - actual;
        let derivative = (error - self.error) / dt;
        self.error = error;
        let ahead = gains.kff_velocity * set.velocity + gains.kff_acceleration * set.acceleration;
        let integral = self.integral + gains.ki * error * dt;
        let wanted = gains.kp * error + integral + gains.kd * derivative + ahead;
        let output = wanted.clamp(-gains.output_max, gains.output_max);
        // At the clamp the integral may only come back.
        if output == wanted || (wanted - output) * error < 0.0 {
            self.integral = integral;
        }
        output
    }

    /// Following error of the last step in mm.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Forgets the past: at enable.
    pub fn reset(&mut self) {
        *self = Self::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GAINS: Gains = Gains { kp: 10.0, ki: 100.0, kd: 0.0, kff_velocity: 1.0, kff_acceleration: 0.0, output_max: 50.0 };

    /// R1-172: the integral does not wind up behind the clamp.
    #[test]
    fn clamp_stops_the_integral() {
        let mut servo = Servo::default();
        let far = SetPoint { position: 1000.0, ..SetPoint::default() };
        for _ in 0..1000 {
            assert_eq!(servo.step(&GAINS, &far, 0.0, 0.001), 50.0);
        }
        assert!(servo.step(&GAINS, &far, 1000.0, 0.001) < 50.0);
    }

    /// R1-184: a P loop without feed-forward lags by V/Kv.
    #[test]
    fn lag_of_a_p_loop() {
        let gains = Gains { ki: 0.0, kff_velocity: 0.0, kp: 50.0, output_max: 1e9, ..GAINS };
        let (mut servo, mut x) = (Servo::default(), 0.0);
        for k in 0..10_000 {
            let set = SetPoint { position: 0.1 * f64::from(k), ..SetPoint::default() };
            x += servo.step(&gains, &set, x, 0.001) * 0.001;
        }
        assert!((servo.error() - 100.0 / 50.0).abs() < 1e-9);
    }
}
