// The highlight's lobe: max(1 - lambda, 0)^exponent, where 1 - lambda is the cosine R.V (Phong) or
// N.H (Blinn-Phong), and cheaper approximations of it. src/glint/shading/lobe.h has the same in
// double, src/glint/shading/bounds.h the error of each. Values that depend only on the exponent are
// computed on the CPU (material.lobe).

// lambda = 1 - R.V = |V - R|^2 / 2 from D = L + V - 2 (N.L) N (Lyon 1993). Near the peak, where the
// lobe is steep, D is small and accurate, whereas R.V is rounded to coarse steps. `lightPlusView` is L + V.
float phongLambda(vec3 n, vec3 lightPlusView, float cosLight) {
  vec3 d = lightPlusView - (2.0 * cosLight) * n;
  return 0.5 * dot(d, d);
}

// lambda = 1 - N.H = |N - H|^2 / 2.
float blinnLambda(vec3 n, vec3 halfVector) {
  vec3 d = n - halfVector;
  return 0.5 * dot(d, d);
}

// log(1 - x) for x in [0, 1), with a small relative error also near 0, where log2(1 - x) has no
// digits left. Up to x = 1/2 it is the series of 2 atanh(-s), s = x / (2 - x) <= 1/3; relative to the
// whole, the first omitted term is less than (1/9)^6 / 13 = 1.5e-7.
float log1m(float x) {
  float s = x / (2.0 - x), t = s * s;
  float series = 1.0 + t * (1.0 / 3.0 + t * (0.2 + t * (1.0 / 7.0 + t * (1.0 / 9.0 + t * (1.0 / 11.0)))));
  return x > 0.5 ? log2(1.0 - x) * 0.69314718056 : -2.0 * s * series;
}

// The power itself. lambda >= 1 is the far side: 0, even for exponent 0, which gives 1 elsewhere.
float lobeExact(float lambda, float exponent) {
  return lambda < 1.0 ? exp2(1.44269504089 * exponent * log1m(lambda)) : 0.0;
}

// The textbook's pow(max(cosine, 0), exponent), with its rounding errors, but never above the peak,
// although the cosine of rounded vectors may exceed 1. pow(0, 0), undefined in GLSL, is avoided.
float lobePow(float cosine, float exponent) {
  return cosine > 0.0 ? pow(min(cosine, 1.0), exponent) : 0.0;
}

// x^power for a constant power from 1 to 255: only the squarings and products that the power needs,
// once the compiler has folded the tests.
float powerOf(float x, int power) {
  float p = (power & 1) != 0 ? x : 1.0, s = x;
  if (power > 1) s *= s;
  if ((power & 2) != 0) p *= s;
  if (power > 3) s *= s;
  if ((power & 4) != 0) p *= s;
  if (power > 7) s *= s;
  if ((power & 8) != 0) p *= s;
  if (power > 15) s *= s;
  if ((power & 16) != 0) p *= s;
  if (power > 31) s *= s;
  if ((power & 32) != 0) p *= s;
  if (power > 63) s *= s;
  if ((power & 64) != 0) p *= s;
  if (power > 127) s *= s;
  if ((power & 128) != 0) p *= s;
  return p;
}

// A whole exponent, by repeated squaring.
float lobeInteger(float lambda, int exponent) { return powerOf(max(1.0 - lambda, 0.0), exponent); }

// Lyon 1993: max(1 - beta lambda, 0)^gamma in place of (1 - lambda)^exponent; close to it near the
// peak, where beta lambda is small; beta = exponent / gamma, or a little less (tuned).
float lobeLyon(float lambda, float beta, int gamma) {
  return powerOf(max(1.0 - beta * lambda, 0.0), gamma);
}

// The same with the cross product: |R x V|^2 / 2 = lambda (2 - lambda) / 2 in place of lambda. It is
// small again at V = -R, hence the gate. `halfBeta` is exponent / (2 gamma).
float lobeLyonCross(float lambda, float halfBeta, int gamma) {
  float base = max(1.0 - halfBeta * (lambda * (2.0 - lambda)), 0.0);
  return lambda < 1.0 ? powerOf(base, gamma) : 0.0;
}

// The [1/1] Pade approximant of (1 - lambda)^beta, beta = exponent / gamma, raised to gamma: `falls`
// is 1 + beta, `rises` beta - 1. Rounding is monotone, so the quotient does not exceed 1.
float lobePade(float lambda, float falls, float rises, int gamma) {
  float top = 2.0 - falls * lambda;
  return top > 0.0 ? powerOf(top / (2.0 + rises * lambda), gamma) : 0.0;
}

// The spherical Gaussian exp(-(exponent + 0.69) lambda); `rate` is (exponent + 0.69) / log(2).
float lobeGaussian(float lambda, float rate) { return exp2(-rate * lambda); }
