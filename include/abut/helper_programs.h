#pragma once

#include <string>

namespace abut {

/// Tells where Abut's helper programs lie: `abut-reader`, which reads FBX, COLLADA and some glTF
/// files, the folder `ifc` for IFC, and the module for MPI. STL, OBJ, PLY, OFF and usual GLB files
/// need none.
///
/// They are looked for beside the running program, in ../libexec/abut of it, then in this folder. A
/// program that is built with `find_package(Abut)` need not call this: the package names its own
/// libexec/abut, wherever it lies when the program is configured. Call it where that folder is moved
/// later. The environment variables ABUT_READER (the program) and ABUT_IFC_CONVERTER (the folder
/// `ifc`) come before all of these.
///
/// In          folder: absolute. To be called before files are read by several threads.
void set_helper_folder(const std::string& folder);

#ifdef ABUT_HELPER_FOLDER
namespace detail {
inline const bool helper_folder_is_set = (set_helper_folder(ABUT_HELPER_FOLDER), true);
}
#endif

} // namespace abut
