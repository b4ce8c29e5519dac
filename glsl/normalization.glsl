// Factors by which a highlight keeps its light when its exponent n changes. They are used if a
// texture varies n; otherwise the material's numbers include the factor.
// src/glint/shading/normalization.h has the same in double, and the sources.
float phongNormalization(float n) { return 0.5 * (n + 2.0); }
float exactPhongNormalization(float n) { return 0.5 * (n + 1.0); }
float blinnNormalization(float n) { return 0.125 * (n + 8.0); }
float exactBlinnNormalization(float n) { return 0.25 * (n + 2.0) / (2.0 - exp2(-0.5 * n)); }
