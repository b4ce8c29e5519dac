#include "glint/image/image.h"
