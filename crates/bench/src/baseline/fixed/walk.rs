//! A loop with a fixed step over whatever contacts: velocity Verlet, or Runge and Kutta's method of order 4.

use super::driven::Driven;
use crate::baseline::form::Form;
use crate::baseline::{Free, Mechanism, Tie};
use pulp::{Arch, Scalar, Simd, WithSimd};

/// A contact that a loop moves.
pub(crate) trait Contact: Clone {
    /// Whether the widest instructions of the machine are worth asking for.
    const WIDE: bool;

    /// Tangential and normal force at the displacement u and the indentation d, m; N. `KEEP`: it goes there, and remembers; otherwise
    /// it looks.
    fn force<S: Simd, const KEEP: bool>(&mut self, simd: S, u: f64, d: f64) -> (f64, f64);
}

/// A loop, after some steps.
pub(super) trait Walker {
    /// Goes on by so many steps.
    fn advance(&mut self, steps: usize);

    /// Places and velocities of the free coordinates.
    fn places(&self) -> (&[f64], &[f64]);
}

/// The loop of so many free coordinates.
pub(super) struct Walk<'t, C, const F: usize> {
    arch: Arch,
    step: f64,
    /// Whether four stages make a step, instead of one.
    staged: bool,
    x: [f64; F],
    v: [f64; F],
    a: [f64; F],
    /// Acceleration by what is constant.
    rest: [f64; F],
    links: Vec<Link<C, F>>,
    driven: Driven<'t>,
}

/// A contact in the loop.
struct Link<C, const F: usize> {
    contact: C,
    slide: Row<F>,
    press: Option<Row<F>>,
}

/// A linear form, and what a force along it does.
struct Row<const F: usize> {
    constant: f64,
    driven: Vec<(usize, f64)>,
    free: [f64; F],
    /// Acceleration of the coordinates by a unit of the force.
    push: [f64; F],
}

impl<'t, C: Contact, const F: usize> Walk<'t, C, F> {
    /// The loop at the start of a mechanism, whose contacts are these.
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
        // Between two places, where the halves of two kicks are one.
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

    /// Accelerations in some places. Counted loops: iterators are not always built in where instructions are chosen at run time.
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

/// So many steps of a loop.
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
