#include "glint/scene/scene.h"
