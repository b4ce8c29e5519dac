/* A fake OSMesa that cannot make an OpenGL 3.3 context; with OLD it makes an older one. */
#include <stddef.h>

#ifdef OLD
static int context;
#endif
static void* current;

static const unsigned char* getString(unsigned name) {
  (void)name;
  return (const unsigned char*)"2.1 Fake";
}

void* OSMesaCreateContextAttribs(const int* attributes, void* share) {
  (void)share;
#ifdef OLD
  int core = 0;
  for (; *attributes; attributes += 2) core |= *attributes == 0x33;
  return core ? NULL : &context;
#else
  (void)attributes;
  return NULL;
#endif
}
void OSMesaDestroyContext(void* destroyed) { (void)destroyed; }
unsigned char OSMesaMakeCurrent(void* made, void* buffer, unsigned type, int width, int height) {
  (void)buffer, (void)type, (void)width, (void)height;
  current = made;
  return 1;
}
void* OSMesaGetCurrentContext(void) { return current; }
void (*OSMesaGetProcAddress(const char* name))(void) {
  (void)name;
  return (void (*)(void))getString;
}
