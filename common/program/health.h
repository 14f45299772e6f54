#pragma once
#include "common/base/result.h"
#include "common/wire/address.h"
#include "common/wire/messages.h"

namespace swath {

// Whether a program of this role and version answers where it listens (any address of this machine: at
// loopback), within a second or so. Blocking. For --health.
Status check_health(const Address& listening, Role role);

}  // namespace swath
