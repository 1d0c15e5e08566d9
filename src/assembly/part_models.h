#pragma once

#include <abut/part_query.h>
#include <abut/scene.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace abut {

/// The parts of model files and stores, for an assembly. Files are read once.
class PartModels {
public:
    /// In          up: the assembly's axis, to which models are turned.
    PartModels(ReadOptions options, UpAxis up);
    ~PartModels();
    PartModels(const PartModels&) = delete;
    PartModels& operator=(const PartModels&) = delete;

    struct Selected {
        std::string id; ///< of the part, if it is one
        Mesh mesh;      ///< in the assembly's frame
    };
    /// Returns the parts that match: all as one mesh, or each.
    ///
    /// Errors      Error, naming the model; none if nothing matches.
    std::vector<Selected> select(const ModelPath& path, const PartQuery& query, bool each);

private:
    class Source;
    class StoreSource;

    Source& source(const ModelPath& path);

    ReadOptions options_;
    UpAxis up_;
    std::map<std::string, std::unique_ptr<Source>> sources_;
};

/// Returns the model that a text in a file names: beside that file, with unit and axis as
/// parse_model_path takes them.
///
/// Errors      Error: file_not_found; unreadable if the model is outside of the file's folder, and
///             `allow_outside` is not set; those of parse_model_path.
ModelPath model_beside(const std::string& text, const std::string& file, bool allow_outside);

} // namespace abut
