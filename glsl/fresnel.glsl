// Reflectance of a smooth boundary between two dielectrics, for unpolarised light, as a function of
// the cosine of incidence c in [0, 1]. The constants of the boundary come from the CPU, in which
// n = n2 / n1 never appears where n - 1 would cancel. Without DENSER_SIDE all boundaries are seen
// from the thinner side, e >= 0.
struct Boundary {
  float e;             // n^2 - 1 = d (2 + d), d = (n2 - n1) / n1
  float square;        // n^2
  float critical;      // from the denser side, the critical cosine sqrt(1 - n^2), else 0; rounded,
  float criticalRest;  // and what the rounding left, for nearest the critical angle R is steep
};

// g^2 = (n cos(theta_t))^2; not positive in total reflection. From the denser side as a product,
// whose first factor keeps its digits where it vanishes; e + c^2 would lose all of them.
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

// As the textbooks write it, with the mean of both polarisations; equal indices, where rounding would
// leave something at grazing angles, give 0 here too.
float fresnelTextbook(float cosine, Boundary b) {
  float c = clamp(cosine, 0.0, 1.0);
  float sin2 = (1.0 - c * c) / b.square;
  if (sin2 >= 1.0 || b.e == 0.0) return b.e == 0.0 ? 0.0 : 1.0;
  float n = sqrt(b.square), t = sqrt(1.0 - sin2);
  float rs = (c - n * t) / (c + n * t), rp = (n * c - t) / (n * c + t);
  return min(0.5 * (rs * rs + rp * rp), 1.0);
}

// The cosine on the thinner side, in which Schlick's family is written: from the denser side that is
// the refracted one, 0 in total reflection.
float thinnerCosine(float cosine, Boundary b) {
  float c = clamp(cosine, 0.0, 1.0);
#if DENSER_SIDE
  return b.e < 0.0 ? min(sqrt(max(refractedSquare(c, b), 0.0) / b.square), 1.0) : c;
#else
  return c;
#endif
}

// R0 + (1 - R0) fall, where `fall` stands for (1 - c)^5: 1 at grazing and in total reflection, where
// c is 0; 0 for equal indices. `normal` is R0, the reflectance at normal incidence.
float schlickFrame(float c, Boundary b, float normal, float fall) {
  return b.e == 0.0 ? 0.0 : c > 0.0 ? normal + (1.0 - normal) * fall : 1.0;
}

// Schlick 1994, with any exponent in place of 5.
float fresnelSchlick(float cosine, Boundary b, float normal, float exponent) {
  float c = thinnerCosine(cosine, b), x = 1.0 - c;
  return schlickFrame(c, b, normal, x > 0.0 ? pow(x, exponent) : exponent > 0.0 ? 0.0 : 1.0);
}

// With the exponent 5, by products.
float fresnelSchlickFifth(float cosine, Boundary b, float normal) {
  float c = thinnerCosine(cosine, b), x = 1.0 - c, x2 = x * x;
  return schlickFrame(c, b, normal, x2 * x2 * x);
}

// Lagarde 2013: one exp2 in place of the products.
float fresnelSchlickExp2(float cosine, Boundary b, float normal) {
  float c = thinnerCosine(cosine, b);
  return schlickFrame(c, b, normal, exp2((-5.55473 * c - 6.98316) * c));
}

// R0 + (1 - R0) ((1 - c) / (1 + k c))^2 with the k that suits the indices best (rationalMinimax of
// src/glint/shading/fresnel.h).
float fresnelRational(float cosine, Boundary b, float normal, float k) {
  float c = thinnerCosine(cosine, b), ratio = (1.0 - c) / (1.0 + k * c);
  return schlickFrame(c, b, normal, ratio * ratio);
}
