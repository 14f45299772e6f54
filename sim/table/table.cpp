#include "sim/table/table.h"
