#include "sim/engine/flow_network.h"
