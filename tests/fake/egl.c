/* A fake EGL with DEVICES GPUs (default 0) and, with SURFACELESS, that platform. INITIALIZES:
   displays initialise. CORE: they have OpenGL 3.3, otherwise only 2.1. It reports a GPU. */
#include <stddef.h>
#include <string.h>

#ifndef DEVICES
#define DEVICES 0
#endif
#ifdef SURFACELESS
#define PLATFORM " EGL_MESA_platform_surfaceless"
#else
#define PLATFORM ""
#endif

typedef void (*Function)(void);

static int device, display, context, error = 0x3000;
static void* current;

static const unsigned char* getString(unsigned name) {
  return (const unsigned char*)(name == 0x1F01 ? "Fake GPU" : "2.1 Fake");
}
static void* getPlatformDisplay(unsigned platform, void* native, const int* attributes) {
  (void)platform, (void)native, (void)attributes;
  return &display;
}
static unsigned queryDevices(int most, void** devices, int* count) {
  for (*count = 0; *count < DEVICES && (!devices || *count < most); ++*count)
    if (devices) devices[*count] = &device;
  return 1;
}
static const char* queryDeviceString(void* of, int name) {
  (void)of;
  return name == 0x3055 ? "EGL_EXT_device_drm" : "/dev/dri/fake";
}

Function eglGetProcAddress(const char* name) {
  if (!strcmp(name, "glGetString")) return (Function)getString;
  if (!strcmp(name, "eglGetPlatformDisplayEXT")) return (Function)getPlatformDisplay;
  if (!strcmp(name, "eglQueryDevicesEXT")) return (Function)queryDevices;
  if (!strcmp(name, "eglQueryDeviceStringEXT")) return (Function)queryDeviceString;
  return NULL;
}
const char* eglQueryString(void* of, int name) {
  (void)name;
  return of ? "EGL_KHR_surfaceless_context EGL_KHR_no_config_context"
            : "EGL_EXT_platform_base EGL_EXT_device_enumeration EGL_EXT_platform_device" PLATFORM;
}
int eglGetError(void) {
  const int code = error;
  error = 0x3000;
  return code;
}
unsigned eglInitialize(void* of, int* major, int* minor) {
  (void)of, (void)major, (void)minor;
#ifdef INITIALIZES
  return 1;
#else
  error = 0x3001;
  return 0;
#endif
}
unsigned eglBindAPI(unsigned api) { return api == 0x30A2; }
unsigned eglChooseConfig(void* of, const int* wanted, void** configs, int most, int* count) {
  (void)of, (void)wanted, (void)configs, (void)most;
  *count = 0;
  return 1;
}
void* eglCreateContext(void* of, void* config, void* share, const int* attributes) {
  (void)of, (void)config, (void)share;
#ifdef CORE
  (void)attributes;
#else
  if (attributes) {
    error = 0x3009;
    return NULL;
  }
#endif
  return &context;
}
unsigned eglDestroyContext(void* of, void* destroyed) { return of && destroyed; }
void* eglCreatePbufferSurface(void* of, void* config, const int* attributes) {
  (void)of, (void)config, (void)attributes;
  return NULL;
}
unsigned eglDestroySurface(void* of, void* surface) { return of && surface; }
unsigned eglMakeCurrent(void* of, void* draw, void* read, void* made) {
  (void)of, (void)draw, (void)read;
  current = made;
  return 1;
}
void* eglGetCurrentContext(void) { return current; }
