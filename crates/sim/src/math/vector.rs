//! Vectors of numbers, one or eight at a time.

use std::ops::{Add, Mul, Neg, Sub};

use super::{Number, Vec3};

/// Three components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<N> {
    pub x: N,
    pub y: N,
    pub z: N,
}

impl<N: Number> Vector<N> {
    #[inline(always)]
    pub const fn new(x: N, y: N, z: N) -> Self {
        Vector { x, y, z }
    }

    #[inline(always)]
    pub fn zeros() -> Self {
        Self::splat(Vec3::zeros())
    }

    /// The same vector in every lane.
    #[inline(always)]
    pub fn splat(vector: Vec3) -> Self {
        Vector::new(N::splat(vector.x), N::splat(vector.y), N::splat(vector.z))
    }

    #[inline(always)]
    pub fn dot(&self, other: &Self) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub fn cross(&self, other: &Self) -> Self {
        Vector::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    #[inline(always)]
    pub fn norm_squared(&self) -> N {
        self.dot(self)
    }

    #[inline(always)]
    pub fn norm(&self) -> N {
        self.norm_squared().sqrt()
    }

    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    pub fn select(mask: N::Mask, yes: Self, no: Self) -> Self {
        Vector::new(
            N::select(mask, yes.x, no.x),
            N::select(mask, yes.y, no.y),
            N::select(mask, yes.z, no.z),
        )
    }
}

impl<N: Number> Add for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Vector::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<N: Number> Sub for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Vector::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<N: Number> Mul<N> for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: N) -> Self {
        Vector::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<N: Number> Neg for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::zeros() - self
    }
}

impl From<Vec3> for Vector<f64> {
    fn from(vector: Vec3) -> Self {
        Vector::new(vector.x, vector.y, vector.z)
    }
}

impl From<Vector<f64>> for Vec3 {
    fn from(vector: Vector<f64>) -> Self {
        Vec3::new(vector.x, vector.y, vector.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_vectors_of_the_algebra_library() {
        let (a, b) = (Vec3::new(1.0, -2.0, 0.5), Vec3::new(-3.0, 0.25, 4.0));
        let (p, q) = (Vector::from(a), Vector::from(b));
        assert_eq!(p.dot(&q), a.dot(&b));
        assert_eq!(Vec3::from(p.cross(&q)), a.cross(&b));
        assert_eq!(Vec3::from(-(p - q) * 2.0 + q), (b - a) * 2.0 + b);
        assert_eq!(p.norm(), a.norm());
    }
}
