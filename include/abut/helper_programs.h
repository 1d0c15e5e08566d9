#pragma once

#include <string>

namespace abut {

/// Sets the folder of Abut's helper programs: `abut-reader`, which reads FBX, COLLADA and some glTF
/// files; the folder `ifc`, which converts IFC; and the module for MPI. STL, OBJ, PLY, OFF and
/// usual GLB files need none of them.
///
/// The library looks for them beside the running program, then in ../libexec/abut relative to it,
/// then in this folder. A program built with `find_package(Abut)` need not call this function: the
/// package sets its own libexec/abut, as located when the program is configured. Call it if that
/// folder is moved later. The environment variables ABUT_READER (the program) and
/// ABUT_IFC_CONVERTER (the folder `ifc`) take precedence over all of these.
///
/// In          folder: an absolute path. Call this before several threads read files.
void set_helper_folder(const std::string& folder);

#ifdef ABUT_HELPER_FOLDER
namespace detail {
inline const bool helper_folder_is_set = (set_helper_folder(ABUT_HELPER_FOLDER), true);
}
#endif

} // namespace abut
