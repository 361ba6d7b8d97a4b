//! Fixed-step loop for any type of contact: velocity Verlet, or Runge–Kutta of order 4.

use super::driven::Driven;
use crate::baseline::form::Form;
use crate::baseline::{Free, Mechanism, Tie};
use pulp::{Arch, Scalar, Simd, WithSimd};

/// Contact in a fixed-step loop.
pub(crate) trait Contact: Clone {
    /// Whether vector instructions are used.
    const WIDE: bool;

    /// Returns tangential and normal force, N, at displacement u and indentation d, m. With `KEEP` the memory is updated.
    fn force<S: Simd, const KEEP: bool>(&mut self, simd: S, u: f64, d: f64) -> (f64, f64);
}

/// Fixed-step loop after some steps.
pub(super) trait Walker {
    /// Advances by a number of steps.
    fn advance(&mut self, steps: usize);

    /// Returns positions and velocities of the free coordinates.
    fn places(&self) -> (&[f64], &[f64]);
}

/// Loop with F free coordinates.
pub(super) struct Walk<'t, C, const F: usize> {
    arch: Arch,
    step: f64,
    /// Whether the method is Runge–Kutta of order 4; otherwise velocity Verlet.
    staged: bool,
    x: [f64; F],
    v: [f64; F],
    a: [f64; F],
    /// Acceleration by constant forces.
    rest: [f64; F],
    links: Vec<Link<C, F>>,
    driven: Driven<'t>,
}

/// Contact with its displacements.
struct Link<C, const F: usize> {
    contact: C,
    slide: Row<F>,
    press: Option<Row<F>>,
}

/// Linear form of the coordinates, and the effect of a force along it.
struct Row<const F: usize> {
    constant: f64,
    driven: Vec<(usize, f64)>,
    free: [f64; F],
    /// Acceleration of the coordinates per unit of force.
    push: [f64; F],
}

impl<'t, C: Contact, const F: usize> Walk<'t, C, F> {
    /// Returns the loop in the initial state of a mechanism with these contacts.
    pub(super) fn new(
        (mechanism, contacts): (&Mechanism, &[C]),
        (step, staged): (f64, bool),
        driven: Driven<'t>,
    ) -> Self {
        let free: [Free; F] = std::array::from_fn(|i| mechanism.free[i]);
        let link = |(tie, contact): (&Tie, &C)| Link {
            contact: contact.clone(),
            slide: Row::new(&tie.slide, (&free, tie.count)),
            press: tie.press.as_ref().map(|press| Row::new(press, (&free, tie.count))),
        };
        let mut walk = Self {
            arch: Arch::new(),
            step,
            staged,
            x: free.map(|free| free.start.0),
            v: free.map(|free| free.start.1),
            a: [0.0; F],
            rest: free.map(|free| free.force / free.mass),
            links: mechanism.ties.iter().zip(contacts).map(link).collect(),
            driven,
        };
        let start = walk.x;
        walk.a = walk.accelerations::<_, true>(Scalar, &start);
        walk
    }

    #[inline(always)]
    fn verlet<S: Simd>(&mut self, simd: S, steps: usize) {
        let (h, mut x, mut v, mut a) = (self.step, self.x, self.v, self.a);
        // Velocities at half steps: the half kicks of neighbouring steps are joined.
        for i in 0..F {
            v[i] += 0.5 * h * a[i];
        }
        for _ in 0..steps {
            for i in 0..F {
                x[i] += h * v[i];
            }
            self.driven.advance(2);
            a = self.accelerations::<S, true>(simd, &x);
            for i in 0..F {
                v[i] += h * a[i];
            }
        }
        for i in 0..F {
            v[i] -= 0.5 * h * a[i];
        }
        (self.x, self.v, self.a) = (x, v, a);
    }

    #[inline(always)]
    fn runge_kutta<S: Simd>(&mut self, simd: S, steps: usize) {
        let (h, mut x, mut v, mut a) = (self.step, self.x, self.v, self.a);
        let half = 0.5 * h;
        for _ in 0..steps {
            self.driven.advance(1);
            let second = std::array::from_fn(|i| x[i] + half * v[i]);
            let b = self.accelerations::<S, false>(simd, &second);
            let third = std::array::from_fn(|i| second[i] + half * half * a[i]);
            let c = self.accelerations::<S, false>(simd, &third);
            self.driven.advance(1);
            let fourth = std::array::from_fn(|i| x[i] + h * (v[i] + half * b[i]));
            let d = self.accelerations::<S, false>(simd, &fourth);
            for i in 0..F {
                x[i] += h * (v[i] + h / 6.0 * (a[i] + b[i] + c[i]));
                v[i] += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
            }
            a = self.accelerations::<S, true>(simd, &x);
        }
        (self.x, self.v, self.a) = (x, v, a);
    }

    /// Returns the accelerations at positions x. Counted loops are used, because iterators may not be inlined in dispatched code.
    #[inline(always)]
    fn accelerations<S: Simd, const KEEP: bool>(&mut self, simd: S, x: &[f64; F]) -> [f64; F] {
        let mut a = self.rest;
        for k in 0..self.links.len() {
            let Link { contact, slide, press } = &mut self.links[k];
            let d = press.as_ref().map_or(0.0, |press| press.value(&self.driven, x));
            let (shear, normal) = contact.force::<S, KEEP>(simd, slide.value(&self.driven, x), d);
            slide.act(&mut a, shear);
            if let Some(press) = press {
                press.act(&mut a, normal);
            }
        }
        a
    }
}

impl<C: Contact, const F: usize> Walker for Walk<'_, C, F> {
    fn advance(&mut self, steps: usize) {
        let arch = self.arch;
        let go = Go(self, steps);
        if C::WIDE { arch.dispatch(go) } else { Scalar.vectorize(go) }
    }

    fn places(&self) -> (&[f64], &[f64]) {
        (&self.x, &self.v)
    }
}

/// Loop together with the number of steps to advance.
struct Go<'w, 't, C, const F: usize>(&'w mut Walk<'t, C, F>, usize);

impl<C: Contact, const F: usize> WithSimd for Go<'_, '_, C, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(walk, steps) = self;
        if walk.staged { walk.runge_kutta(simd, steps) } else { walk.verlet(simd, steps) }
    }
}

impl<const F: usize> Row<F> {
    fn new(form: &Form, (bodies, count): (&[Free; F], f64)) -> Self {
        let free = std::array::from_fn(|i| form.free[i]);
        let push = std::array::from_fn(|i| -count * form.free[i] / bodies[i].mass);
        Self { constant: form.constant, driven: form.driven.clone(), free, push }
    }

    #[inline(always)]
    fn value(&self, driven: &Driven<'_>, x: &[f64; F]) -> f64 {
        let (free, mut value) = (&self.free, self.constant);
        for k in 0..self.driven.len() {
            let (track, factor) = self.driven[k];
            value += factor * driven.values[track];
        }
        for i in 0..F {
            value += free[i] * x[i];
        }
        value
    }

    #[inline(always)]
    fn act(&self, a: &mut [f64; F], force: f64) {
        let push = &self.push;
        for i in 0..F {
            a[i] += push[i] * force;
        }
    }
}
