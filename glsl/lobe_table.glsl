// The lobe from a table of floats, which the CPU computes for each material's exponent.
// src/glint/shading/lobe.h has the same in double.

// Tables of powers of the cosine, one after the other, each starting at the beginning of a vec4.
layout(std140) uniform LobeTableBlock {
  vec4 lobeTables[LOBE_TABLES];
};
float tableEntry(int table, int place) { return lobeTables[table + (place >> 2)][place & 3]; }

// Interpolates in the table of `steps` steps, a power of two, that begins at the vec4 `table`.
float lobeTable(float cosine, int table, int steps) {
  float place = clamp(cosine, 0.0, 1.0) * float(steps);
  int below = min(int(place), steps - 1);
  float share = place - float(below);
  return (1.0 - share) * tableEntry(table, below) + share * tableEntry(table, below + 1);
}
