// What a highlight is multiplied by so that it keeps its light when its exponent n moves, where a
// texture gives what n depends on; elsewhere it comes with the material's numbers.
// src/glint/shading/normalization.h has the same in double, and the sources.
float phongNormalization(float n) { return 0.5 * (n + 2.0); }
float exactPhongNormalization(float n) { return 0.5 * (n + 1.0); }
float blinnNormalization(float n) { return 0.125 * (n + 8.0); }
float exactBlinnNormalization(float n) { return 0.25 * (n + 2.0) / (2.0 - exp2(-0.5 * n)); }
