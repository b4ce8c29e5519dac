#ifdef OWN_LOADER
#include <glad/gl.h>
#endif

int embedded(void);

int main(void) {
#ifdef OWN_LOADER
  /* Never loaded: glint loads its own. */
  if (glad_glGetString != 0 || GLAD_GL_VERSION_4_6 != 0) return 3;
#endif
  return embedded();
}
