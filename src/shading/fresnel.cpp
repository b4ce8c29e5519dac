#include "glint/image/error.h"
