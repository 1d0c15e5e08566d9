#pragma once

#include <abut/elementary_impact.h>

#include "tests/support/oracle/exact_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Decides whether and when two moving features meet, in integers and independently of the
/// library's method. The normal equations give the nearest point of a face, or the nearest points
/// of two edges. Sturm sequences and Tarski queries give signs at roots [Basu, Pollack, Roy 2006,
/// 2.2].
namespace abut::test {

/// Coefficients in ascending order without trailing zeros. The zero polynomial is empty.
template <typename Int>
using Poly = std::vector<Int>;

template <typename Int>
Poly<Int> trimmed(Poly<Int> p) {
    while (!p.empty() && p.back() == 0)
        p.pop_back();
    return p;
}
template <typename Int>
Poly<Int> plus(const Poly<Int>& a, const Poly<Int>& b, int factor = 1) {
    Poly<Int> r(std::max(a.size(), b.size()), Int(0));
    for (std::size_t i = 0; i < a.size(); ++i)
        r[i] += a[i];
    for (std::size_t i = 0; i < b.size(); ++i)
        r[i] += factor * b[i];
    return trimmed(std::move(r));
}
template <typename Int>
Poly<Int> minus(const Poly<Int>& a, const Poly<Int>& b) {
    return plus(a, b, -1);
}
template <typename Int>
Poly<Int> times(const Poly<Int>& a, const Poly<Int>& b) {
    if (a.empty() || b.empty())
        return {};
    Poly<Int> r(a.size() + b.size() - 1, Int(0));
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < b.size(); ++k)
            r[i + k] += a[i] * b[k];
    return trimmed(std::move(r));
}
template <typename Int>
Poly<Int> derived(const Poly<Int>& p) {
    Poly<Int> r;
    for (std::size_t i = 1; i < p.size(); ++i)
        r.push_back(Int(static_cast<int>(i)) * p[i]);
    return r;
}
/// Divides by the greatest common divisor of the coefficients, which keeps them small.
template <typename Int>
Poly<Int> primitive(Poly<Int> p) {
    Int common = 0;
    for (const Int& c : p)
        common = gcd(common, c);
    if (common > 1)
        for (Int& c : p)
            c /= common;
    return p;
}
/// Remainder of a positive multiple of a, divided by b. `quotient` receives the quotient.
template <typename Int>
Poly<Int> remainder(Poly<Int> a, const Poly<Int>& b, Poly<Int>* quotient = nullptr) {
    const Int square = b.back() * b.back();
    if (quotient != nullptr)
        quotient->assign(a.size() >= b.size() ? a.size() - b.size() + 1 : 0, Int(0));
    while (a.size() >= b.size()) {
        const Int factor = a.back() * b.back();
        const std::size_t shift = a.size() - b.size();
        for (Int& c : a)
            c *= square;
        if (quotient != nullptr) {
            for (Int& c : *quotient)
                c *= square;
            (*quotient)[shift] += factor;
        }
        for (std::size_t i = 0; i < b.size(); ++i)
            a[i + shift] -= factor * b[i];
        a = trimmed(std::move(a));
    }
    return a;
}

/// The time n / 2^k.
template <typename Int>
struct DyadicTime {
    Int n;
    unsigned k = 0;

    [[nodiscard]] double value() const {
        return std::ldexp(static_cast<double>(n), -static_cast<int>(k));
    }
};

template <typename Int>
int sign_at(const Poly<Int>& p, const DyadicTime<Int>& t) {
    Int sum = 0, power = 1;
    for (std::size_t i = p.size(); i-- > 0; power <<= t.k)
        sum = sum * t.n + p[i] * power;
    return sign_of(sum);
}

/// The sign of g from a time n / 2^k to (n + 1) / 2^k, if all its Bernstein coefficients there have
/// it; else 0. It only saves work: 0 says nothing.
template <typename Int>
int sign_throughout(const Poly<Int>& g, const DyadicTime<Int>& low) {
    const std::size_t n = g.size();
    if (n == 0)
        return 0;
    // Coefficients of g((n + s) / 2^k), times a power of 2.
    Poly<Int> q = g;
    for (std::size_t i = 0; i < n; ++i)
        q[i] *= Int(1) << (low.k * static_cast<unsigned>(n - 1 - i)); // shifts take no sign
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = n - 1; j > i; --j)
            q[j - 1] += low.n * q[j];
    // Coefficient i is the sum of q[j] binomial(i, j) / binomial(n - 1, j).
    std::vector<Int> factorial(n, Int(1));
    for (std::size_t i = 1; i < n; ++i)
        factorial[i] = factorial[i - 1] * static_cast<int>(i);
    int found = 0;
    for (std::size_t i = 0; i < n; ++i) {
        Int sum = 0;
        for (std::size_t j = 0; j <= i; ++j)
            sum += q[j] * (factorial[i] / factorial[i - j] * factorial[n - 1 - j]);
        const int sign = sign_of(sum);
        if (sign == 0 || sign * found < 0)
            return 0;
        found = sign;
    }
    return found;
}

/// Sturm chain: p, q, then the negated remainder of each two successive ones.
template <typename Int>
std::vector<Poly<Int>> sturm_chain(const Poly<Int>& p, const Poly<Int>& q) {
    std::vector<Poly<Int>> chain{primitive(p)};
    for (Poly<Int> next = primitive(q); !next.empty();) {
        chain.push_back(std::move(next));
        next = primitive(remainder(chain[chain.size() - 2], chain.back()));
        for (Int& c : next)
            c = -c;
    }
    return chain;
}
template <typename Int>
int variations(const std::vector<Poly<Int>>& chain, const DyadicTime<Int>& t) {
    int count = 0, last = 0;
    for (const auto& p : chain) {
        const int sign = sign_at(p, t);
        count += sign * last < 0 ? 1 : 0;
        last = sign != 0 ? sign : last;
    }
    return count;
}

/// The only root of a square-free polynomial in (low, high].
template <typename Int>
class OracleRoot {
public:
    OracleRoot(Poly<Int> p, std::vector<Poly<Int>> chain, DyadicTime<Int> low, DyadicTime<Int> high)
        : p_(std::move(p)), chain_(std::move(chain)), low_(low), high_(high) {
        // A Tarski query needs interval ends that are not roots.
        while (!is_high() && sign_at(p_, low_) == 0)
            halve();
    }
    [[nodiscard]] int sign(const Poly<Int>& g) const {
        if (is_high())
            return sign_at(g, high_);
        if (const int sign = sign_throughout(g, low_))
            return sign;
        const auto chain = sturm_chain(p_, times(derived(p_), g));
        return variations(chain, low_) - variations(chain, high_);
    }
    void refine(unsigned k) {
        while (!is_high() && high_.k < k)
            halve();
    }
    [[nodiscard]] double low() const { return is_high() ? high_.value() : low_.value(); }
    [[nodiscard]] double high() const { return high_.value(); }

private:
    [[nodiscard]] bool is_high() const { return sign_at(p_, high_) == 0; }
    void halve() {
        const DyadicTime<Int> middle{Int(low_.n + high_.n), low_.k + 1};
        // The root is the only one, and simple. So the sign changes at it if the interval's ends
        // are no roots.
        const int at_low = sign_at(p_, low_);
        const bool left = at_low != 0 ? sign_at(p_, middle) != at_low
                                      : variations(chain_, low_) - variations(chain_, middle) == 1;
        low_ = {Int(2 * low_.n), low_.k + 1}, high_ = {Int(2 * high_.n), high_.k + 1};
        (left ? high_ : low_) = middle;
    }

    Poly<Int> p_;
    std::vector<Poly<Int>> chain_;
    DyadicTime<Int> low_, high_;
};

/// All roots in [0, 1]. In: not the zero polynomial.
template <typename Int>
std::vector<OracleRoot<Int>> oracle_roots(const Poly<Int>& p) {
    std::vector<OracleRoot<Int>> roots;
    if (p.size() < 2 || sign_throughout(p, {Int(0), 0}) != 0)
        return roots;
    Poly<Int> square_free = primitive(p);
    const auto repeated = sturm_chain(p, derived(p)).back();
    if (repeated.size() > 1)
        remainder(Poly<Int>(square_free), repeated, &square_free);
    square_free = primitive(square_free);
    const auto chain = sturm_chain(square_free, derived(square_free));
    struct Range {
        DyadicTime<Int> low, high;
    };
    // The root 0 is represented by the polynomial t, whose only root in (-1, 0] it is.
    if (sign_at(square_free, {Int(0), 0}) == 0)
        roots.emplace_back(Poly<Int>{Int(0), Int(1)},
                           sturm_chain(Poly<Int>{Int(0), Int(1)}, Poly<Int>{Int(1)}),
                           DyadicTime<Int>{Int(-1), 0}, DyadicTime<Int>{Int(0), 0});
    std::vector<Range> stack{{{Int(0), 0}, {Int(1), 0}}};
    while (!stack.empty()) {
        const auto [low, high] = stack.back();
        stack.pop_back();
        const int count = variations(chain, low) - variations(chain, high);
        if (count == 1)
            roots.emplace_back(square_free, chain, low, high);
        if (count <= 1)
            continue;
        const DyadicTime<Int> middle{Int(low.n + high.n), low.k + 1};
        stack.push_back({middle, {Int(2 * high.n), high.k + 1}});
        stack.push_back({{Int(2 * low.n), low.k + 1}, middle});
    }
    return roots;
}

/// An interval that contains a time.
struct OracleTime {
    double low, high;
};

template <typename Int>
using PolyPoint = Point<Poly<Int>>;

/// The conditions on signs at a time under which the features meet.
template <typename Int>
class CcdOracle {
public:
    explicit CcdOracle(const ElementaryPair& pair) : kind_(pair.kind) {
        std::vector<Vec3> all(pair.start.begin(), pair.start.end());
        all.insert(all.end(), pair.end.begin(), pair.end.end());
        const auto p = as_integers<Int>(all);
        const auto line = [](const Int& a, const Int& b) {
            return trimmed(Poly<Int>{a, Int(b - a)});
        };
        for (std::size_t i = 0; i < 4; ++i)
            x_[i] = {line(p[i].x, p[i + 4].x), line(p[i].y, p[i + 4].y), line(p[i].z, p[i + 4].z)};
        if (kind_ == ElementaryKind::vertex_face)
            prepare(x_[1], x_[2], x_[1], x_[3], x_[1], x_[0]);
        else
            prepare(x_[0], x_[1], x_[3], x_[2], x_[0], x_[2]);
        segments_ = kind_ == ElementaryKind::vertex_face
                        ? std::vector<std::array<std::size_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}
                        : std::vector<std::array<std::size_t, 3>>{
                              {0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}};
    }

    /// Whether all four vertices lie in one plane at some time.
    [[nodiscard]] bool comes_into_a_plane() const { return volume_.empty() || !flat_.empty(); }

    /// The first time of contact, to about 2^-50; none if the features do not meet.
    [[nodiscard]] std::optional<OracleTime> first() const {
        std::vector<OracleRoot<Int>> times = flat_;
        if (volume_.empty()) {
            if (meet_at([](const Poly<Int>& g) { return sign_at(g, {Int(0), 0}); }))
                return OracleTime{0, 0};
            for (const auto& p : relevant())
                for (auto& root : oracle_roots(p))
                    times.push_back(std::move(root));
        }
        std::optional<OracleTime> first;
        for (OracleRoot<Int>& time : times) {
            time.refine(24); // a short interval, in which most signs are the same throughout
            if (!meet_at([&](const Poly<Int>& g) { return time.sign(g); }))
                continue;
            time.refine(50);
            if (!first || time.low() < first->low)
                first = OracleTime{time.low(), time.high()};
            if (!volume_.empty())
                break;
        }
        return first;
    }

private:
    static PolyPoint<Int> sub(const PolyPoint<Int>& a, const PolyPoint<Int>& b) {
        return {test::minus(a.x, b.x), test::minus(a.y, b.y), test::minus(a.z, b.z)};
    }
    static Poly<Int> dot_of(const PolyPoint<Int>& a, const PolyPoint<Int>& b) {
        return plus(times(a.x, b.x), plus(times(a.y, b.y), times(a.z, b.z)));
    }
    static PolyPoint<Int> cross_of(const PolyPoint<Int>& a, const PolyPoint<Int>& b) {
        return {test::minus(times(a.y, b.z), times(a.z, b.y)),
                test::minus(times(a.z, b.x), times(a.x, b.z)),
                test::minus(times(a.x, b.y), times(a.y, b.x))};
    }

    /// Solves r = s u + h v in the plane of u = u1 - u0 and v = v1 - v0, where r = r1 - r0, by
    /// Cramer's rule on the normal equations.
    void prepare(const PolyPoint<Int>& u0, const PolyPoint<Int>& u1, const PolyPoint<Int>& v0,
                 const PolyPoint<Int>& v1, const PolyPoint<Int>& r0, const PolyPoint<Int>& r1) {
        const auto u = sub(u1, u0), v = sub(v1, v0), r = sub(r1, r0);
        volume_ = dot_of(r, cross_of(u, v));
        flat_ = oracle_roots(volume_);
        if (!comes_into_a_plane())
            return;
        const auto uu = dot_of(u, u), uv = dot_of(u, v), vv = dot_of(v, v), ru = dot_of(r, u),
                   rv = dot_of(r, v);
        whole_ = test::minus(times(uu, vv), times(uv, uv));
        s_ = test::minus(times(ru, vv), times(rv, uv));
        h_ = test::minus(times(rv, uu), times(ru, uv));
        inside_ = {s_, h_};
        if (kind_ == ElementaryKind::vertex_face) {
            inside_.push_back(test::minus(whole_, plus(s_, h_)));
        } else {
            inside_.push_back(test::minus(whole_, s_));
            inside_.push_back(test::minus(whole_, h_));
        }
    }

    template <typename Sign>
    [[nodiscard]] bool meet_at(const Sign& sign) const {
        if (sign(whole_) > 0) {
            for (const auto& p : inside_)
                if (sign(p) < 0)
                    return false;
            return true;
        }
        return std::any_of(segments_.begin(), segments_.end(), [&](const auto& segment) {
            const auto [off_line, between] = on_segment(segment);
            return sign(off_line) == 0 && sign(between) <= 0;
        });
    }

    /// Zero where the point lies on the segment's line; not positive where, on the line, it lies
    /// between the ends.
    [[nodiscard]] std::array<Poly<Int>, 2>
    on_segment(const std::array<std::size_t, 3>& segment) const {
        const auto& [point, from, to] = segment;
        const auto u = sub(x_[from], x_[point]), v = sub(x_[to], x_[point]);
        const auto n = cross_of(u, v);
        return {dot_of(n, n), dot_of(u, v)};
    }

    [[nodiscard]] std::vector<Poly<Int>> relevant() const {
        std::vector<Poly<Int>> all = inside_;
        all.push_back(whole_);
        for (const auto& segment : segments_)
            for (const auto& p : on_segment(segment))
                all.push_back(p);
        return all;
    }

    ElementaryKind kind_;
    std::array<PolyPoint<Int>, 4> x_;
    Poly<Int> volume_, whole_, s_, h_;
    std::vector<OracleRoot<Int>>
        flat_; ///< when all vertices lie in one plane, unless they always do
    std::vector<Poly<Int>> inside_;
    std::vector<std::array<std::size_t, 3>> segments_; ///< a point and the ends of a segment
};

} // namespace abut::test
