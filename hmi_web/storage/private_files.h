#pragma once

// Whose the files are that the page's server keeps beside its databases: users, the audit trail, what is
// forced, recipes, trends, screens, programs, what has been told. Plain values; any thread.

#include "runtime/ground/files/durable_file.h"

namespace stepwright::storage {

inline constexpr const char* kFileFails = "H0021";

inline constexpr files::Owner kPrivateFile{
    kFileFails,
    "users and the audit trail are kept in [hmi] access_dir, recipes in recipes_dir, "
    "programs in programs_dir, screens in screens_dir"};

}  // namespace stepwright::storage
