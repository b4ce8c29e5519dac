// Reflectance of a smooth boundary between two dielectrics, for unpolarised light, as a function of
// the cosine of incidence c in [0, 1]. The constants of the boundary come from the CPU, in which
// n = n2 / n1 never appears where n - 1 would cancel.
struct Boundary {
  float e;             // n^2 - 1 = d (2 + d), d = (n2 - n1) / n1
  float square;        // n^2
  float critical;      // from the denser side, the critical cosine sqrt(1 - n^2), else 0; rounded,
  float criticalRest;  // and what the rounding left, for nearest the critical angle R is steep
};

// g^2 = (n cos(theta_t))^2; not positive in total reflection. From the denser side as a product,
// whose first factor keeps its digits where it vanishes; e + c^2 would lose all of them.
float refractedSquare(float c, Boundary b) {
  return b.e < 0.0 ? ((c - b.critical) - b.criticalRest) * (c + b.critical) : b.e + c * c;
}

// Free of cancellation (amplitudes times their conjugates): rs = e / (c + g)^2 and
// rp = e q / (n^2 c + g)^2, with g = n cos(theta_t). Total reflection (g^2 <= 0) gives 1; equal
// indices (e = 0) give 0 at every angle.
float fresnelExact(float cosine, Boundary b) {
  float c = clamp(cosine, 0.0, 1.0), g2 = refractedSquare(c, b);
  float q = b.e < 0.0 ? g2 - b.square * ((1.0 - c) * (1.0 + c)) : (b.square + 1.0) * (c * c) - 1.0;
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

// Schlick 1994: R0 + (1 - R0)(1 - c)^exponent, with the cosine on the thinner side: from the denser
// side that is the refracted one, and beyond the critical angle R is 1. Equal indices give 0.
float fresnelSchlick(float cosine, Boundary b, float exponent) {
  float c = clamp(cosine, 0.0, 1.0), n = sqrt(b.square);
  if (b.e == 0.0) return 0.0;
  if (b.e < 0.0) {
    float g2 = refractedSquare(c, b);
    if (g2 <= 0.0) return 1.0;
    c = min(sqrt(g2) / n, 1.0);
  }
  float normal = b.e / ((n + 1.0) * (n + 1.0)), x = 1.0 - c;
  float r0 = normal * normal;
  return r0 + (1.0 - r0) * (x > 0.0 ? pow(x, exponent) : exponent > 0.0 ? 0.0 : 1.0);
}
