// Where what the tests read and run is. Only paths.cpp is compiled with these folders' names, so that
// objects of all other files can be shared between copies of the project.
#pragma once

namespace sporeprint {

/// Returns the absolute path of the project's folder.
const char* source_folder();

/// Returns the absolute path of the program `sporeprint` of this build.
const char* server_program();

}  // namespace sporeprint
