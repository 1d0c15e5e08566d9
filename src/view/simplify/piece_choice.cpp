#include "view/simplify/piece_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace abut {

namespace {

/// Halvings of the range of errors that is searched, and that range.
constexpr int kErrorSteps = 6;
constexpr double kErrorRange = 64;

/// Pieces that are kept.
class KeptSticks {
public:
    /// In          added: the distance of the form from the stick's piece.
    void add(const Stick& stick, double added) {
        Kept kept{stick, {}, stick.radius + added};
        extend(kept.box, stick.a);
        extend(kept.box, stick.b);
        kept_.push_back(kept);
    }

    /// An upper bound, below `most`, on the distance of any point of the stick from one of them.
    [[nodiscard]] std::optional<double> gap(const Stick& from, double most) const {
        const double reach = most - from.radius;
        for (const Kept& to : kept_) {
            const double left = reach - to.thickness;
            if (!(left > 0) || is_apart(from.a, to.box, left) || is_apart(from.b, to.box, left))
                continue;
            if (const double found = axis_gap(from, to.stick); found <= left)
                return found + from.radius + to.thickness;
        }
        return std::nullopt;
    }

private:
    struct Kept {
        Stick stick;
        Box3 box;
        double thickness = 0;
    };
    static bool is_apart(const Vec3& p, const Box3& box, double by) {
        return p.x < box.lower.x - by || p.x > box.upper.x + by || p.y < box.lower.y - by ||
               p.y > box.upper.y + by || p.z < box.lower.z - by || p.z > box.upper.z + by;
    }

    std::vector<Kept> kept_;
};

} // namespace

PieceChooser::PieceChooser(std::span<const PieceForms> pieces, double resting)
    : pieces_(pieces), order_(pieces_.size()), resting_(resting) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return pieces_[a].size > pieces_[b].size;
    });
}

/// The error of what a piece stands for: itself, and pieces that rest on it.
double PieceChooser::base(const PieceForms& piece) const {
    return std::max(piece.error, resting_);
}

double PieceChooser::left_out_error(const PieceForms& piece) const {
    return piece.size + 2 * base(piece);
}

PieceChoice PieceChooser::within(double error, bool with_rest) const {
    PieceChoice choice;
    choice.form.assign(pieces_.size(), PieceChoice::kLeftOut);
    KeptSticks kept;
    for (const std::uint32_t p : order_) {
        const PieceForms& piece = pieces_[p];
        if (left_out_error(piece) <= error) {
            choice.error = std::max(choice.error, left_out_error(piece));
            continue;
        }
        int best = -1;
        for (std::size_t i = 0; i < piece.forms.size(); ++i)
            if (base(piece) + piece.forms[i].added <= error)
                best = static_cast<int>(i);
        if (best < 0) {
            choice.is_possible = false;
            return choice;
        }
        if (with_rest) {
            if (const auto gap = kept.gap(piece.stick, error - base(piece))) {
                choice.form[p] = PieceChoice::kRests;
                choice.resting = std::max(choice.resting, base(piece) + *gap);
                continue;
            }
        }
        const PieceForms::Form& form = piece.forms[static_cast<std::size_t>(best)];
        if (with_rest)
            kept.add(piece.stick, form.added);
        choice.form[p] = best;
        choice.triangles += form.triangles;
        choice.error = std::max(choice.error, base(piece) + form.added);
        if (resting_ > 0)
            choice.resting = std::max(choice.resting, resting_ + form.added);
    }
    choice.error = std::max(choice.error, choice.resting);
    return choice;
}

double PieceChooser::least_without_rest(std::uint64_t triangles) const {
    std::vector<double> errors{0};
    for (const PieceForms& piece : pieces_) {
        errors.push_back(left_out_error(piece));
        for (const PieceForms::Form& form : piece.forms)
            errors.push_back(base(piece) + form.added);
    }
    std::sort(errors.begin(), errors.end());
    return *std::partition_point(errors.begin(), errors.end() - 1, [&](double error) {
        const PieceChoice choice = within(error, false);
        return !choice.is_possible || choice.triangles > triangles;
    });
}

PieceChoice PieceChooser::least_error(std::uint64_t triangles) const {
    double most = least_without_rest(triangles), least = 0;
    PieceChoice best = within(most, false);
    if (best.triangles > triangles)
        return best; // nothing can be left out
    for (const PieceForms& piece : pieces_)
        least = std::max(least, base(piece));
    least = std::max(least, most / kErrorRange);
    // The number of triangles does not always fall with the error; nearly always is enough.
    for (int step = 0; step < kErrorSteps && least < most / 1.05; ++step) {
        const double error = std::sqrt(least * most);
        PieceChoice choice = within(error, true);
        if (choice.is_possible && choice.triangles <= triangles)
            best = std::move(choice), most = error;
        else
            least = error;
    }
    return best;
}

} // namespace abut
