// Reflectance of a smooth boundary between two dielectrics, for unpolarised light, as a function of
// the cosine of incidence c in [0, 1]. The CPU computes the constants of the boundary without
// forming n - 1 from n = n2 / n1, which would cancel. Without DENSER_SIDE all boundaries are seen
// from the thinner side, e >= 0.
struct Boundary {
  float e;             // n^2 - 1 = d (2 + d), d = (n2 - n1) / n1
  float square;        // n^2
  float critical;      // from the denser side the critical cosine sqrt(1 - n^2), rounded; else 0
  float criticalRest;  // its rounding error, since R is steep close to the critical angle
};

// g^2 = (n cos(theta_t))^2; not positive in total reflection. From the denser side it is a product
// whose first factor keeps its digits as it goes to 0; e + c^2 would lose all of them.
float refractedSquare(float c, Boundary b) {
#if DENSER_SIDE
  return b.e < 0.0 ? ((c - b.critical) - b.criticalRest) * (c + b.critical) : b.e + c * c;
#else
  return b.e + c * c;
#endif
}

// Free of cancellation (amplitudes times their conjugates): rs = e / (c + g)^2 and
// rp = e q / (n^2 c + g)^2, with g = n cos(theta_t). Total reflection (g^2 <= 0) gives 1; equal
// indices (e = 0) give 0 at every angle.
float fresnelExact(float cosine, Boundary b) {
  float c = clamp(cosine, 0.0, 1.0), g2 = refractedSquare(c, b);
  float q = (b.square + 1.0) * (c * c) - 1.0;
#if DENSER_SIDE
  if (b.e < 0.0) q = g2 - b.square * ((1.0 - c) * (1.0 + c));
#endif
  float g = sqrt(max(g2, 0.0));
  float s = c + g, p = b.square * c + g;
  float rs = b.e / (s * s), rp = b.e * q / (p * p);
  return b.e == 0.0 ? 0.0 : g2 > 0.0 ? min(0.5 * (rs * rs + rp * rp), 1.0) : 1.0;
}

// The textbook form, with the mean of both polarisations. Equal indices give 0 here, too, where
// rounding would leave a nonzero value at grazing angles.
float fresnelTextbook(float cosine, Boundary b) {
  float c = clamp(cosine, 0.0, 1.0);
  float sin2 = (1.0 - c * c) / b.square;
  if (sin2 >= 1.0 || b.e == 0.0) return b.e == 0.0 ? 0.0 : 1.0;
  float n = sqrt(b.square), t = sqrt(1.0 - sin2);
  float rs = (c - n * t) / (c + n * t), rp = (n * c - t) / (n * c + t);
  return min(0.5 * (rs * rs + rp * rp), 1.0);
}

// The cosine on the thinner side, in which Schlick's family is written: from the denser side it is
// that of the refracted ray, 0 in total reflection.
float thinnerCosine(float cosine, Boundary b) {
  float c = clamp(cosine, 0.0, 1.0);
#if DENSER_SIDE
  return b.e < 0.0 ? min(sqrt(max(refractedSquare(c, b), 0.0) / b.square), 1.0) : c;
#else
  return c;
#endif
}

// R0 + (1 - R0) fall, where `fall` is (1 - c)^5 or an approximation of it. 1 at grazing incidence and
// in total reflection, where c is 0; 0 for equal indices. `normal` is R0, the reflectance at normal incidence.
float schlickFrame(float c, Boundary b, float normal, float fall) {
  return b.e == 0.0 ? 0.0 : c > 0.0 ? normal + (1.0 - normal) * fall : 1.0;
}

// Schlick 1994, with any exponent in place of 5.
float fresnelSchlick(float cosine, Boundary b, float normal, float exponent) {
  float c = thinnerCosine(cosine, b), x = 1.0 - c;
  return schlickFrame(c, b, normal, x > 0.0 ? pow(x, exponent) : exponent > 0.0 ? 0.0 : 1.0);
}

// With the exponent 5, by multiplication.
float fresnelSchlickFifth(float cosine, Boundary b, float normal) {
  float c = thinnerCosine(cosine, b), x = 1.0 - c, x2 = x * x;
  return schlickFrame(c, b, normal, x2 * x2 * x);
}

// Lagarde 2013: one exp2 in place of the multiplications.
float fresnelSchlickExp2(float cosine, Boundary b, float normal) {
  float c = thinnerCosine(cosine, b);
  return schlickFrame(c, b, normal, exp2((-5.55473 * c - 6.98316) * c));
}

// R0 + (1 - R0) ((1 - c) / (1 + k c))^2 with the k that has the smallest largest error for the
// indices (rationalMinimax of src/glint/shading/fresnel.h).
float fresnelRational(float cosine, Boundary b, float normal, float k) {
  float c = thinnerCosine(cosine, b), ratio = (1.0 - c) / (1.0 + k * c);
  return schlickFrame(c, b, normal, ratio * ratio);
}
