// The highlight's lobe: max(1 - lambda, 0)^exponent, where 1 - lambda is the cosine R.V (Phong) or
// N.H (Blinn-Phong).

// lambda = 1 - R.V = |V - R|^2 / 2 from D = L + V - 2 (N.L) N (Lyon 1993): near the peak, where the
// lobe is steep, D is small and exact while R.V rounds to a staircase. `lightPlusView` is L + V.
float phongLambda(vec3 n, vec3 lightPlusView, float cosLight) {
  vec3 d = lightPlusView - (2.0 * cosLight) * n;
  return 0.5 * dot(d, d);
}

// lambda = 1 - N.H = |N - H|^2 / 2.
float blinnLambda(vec3 n, vec3 halfVector) {
  vec3 d = n - halfVector;
  return 0.5 * dot(d, d);
}

// log(1 - x) for x in [0, 1), with small relative error near 0, where log2(1 - x) has none left.
// Up to x = 1/2: 2 atanh(-s), s = x / (2 - x) <= 1/3, by its series; the first term left out is
// less than (1/9)^6 / 13 = 1.5e-7 of the whole.
float log1m(float x) {
  float s = x / (2.0 - x), t = s * s;
  float series = 1.0 + t * (1.0 / 3.0 + t * (0.2 + t * (1.0 / 7.0 + t * (1.0 / 9.0 + t * (1.0 / 11.0)))));
  return x > 0.5 ? log2(1.0 - x) * 0.69314718056 : -2.0 * s * series;
}

// The power itself. lambda >= 1 is the far side: 0, also at exponent 0, where the rest is 1.
float lobeExact(float lambda, float exponent) {
  return lambda < 1.0 ? exp2(1.44269504089 * exponent * log1m(lambda)) : 0.0;
}

// The textbook's pow(max(cosine, 0), exponent), with its rounding, but never above the peak, which
// the cosine of rounded vectors may exceed; pow(0, 0) is undefined in GLSL.
float lobePow(float cosine, float exponent) {
  return cosine > 0.0 ? pow(min(cosine, 1.0), exponent) : 0.0;
}
