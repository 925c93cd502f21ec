#pragma once

// Check of a command's standard output: what the system did not take, as with a full disk behind `> file`, is
// told, once, when the process ends.

namespace stepwright::process {

// From now on a process that ends with success, and whose standard output could not be written, says so on
// stderr (E0002) and ends with ExitCode::BadInput. A reader that has gone away (`| head`) is no such error.
// Threads: the main one, once.
void tell_lost_output();

}  // namespace stepwright::process
