#include <glad/gl.h>
