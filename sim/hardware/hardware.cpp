#include "sim/hardware/hardware.h"
