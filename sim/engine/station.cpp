#include "sim/engine/station.h"
