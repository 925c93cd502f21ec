#pragma once

/* What the FMUs of FMI 3.0 here have in common: results of calls, and a pair of functions for each type of
 * number. */
#include <stdbool.h>
#include <stdint.h>

#define EXPORT __attribute__((visibility("default")))
enum { OK = 0, ERROR = 3 };

/* `ACCESS(NAME, TYPE)` defines fmi3SetNAME and fmi3GetNAME. */
#define ACCESS_ALL(ACCESS) \
  ACCESS(Float64, double)  \
  ACCESS(Float32, float)   \
  ACCESS(Int8, int8_t)     \
  ACCESS(UInt8, uint8_t)   \
  ACCESS(Int16, int16_t)   \
  ACCESS(UInt16, uint16_t) \
  ACCESS(Int32, int32_t)   \
  ACCESS(UInt32, uint32_t) \
  ACCESS(Int64, int64_t)   \
  ACCESS(UInt64, uint64_t) \
  ACCESS(Boolean, bool)
