/*
 * carvel.hpp - the C++17 interface of carvel, a subdivision-surface kernel.
 *
 * A thin layer over carvel.h, in this file alone: handles that destroy what they
 * own, results by value, arrays of your own types read and written where they
 * are. It checks nothing that the library checks and computes nothing, so the
 * manual is carvel.h: ranges, costs, errors and constants are those given there.
 *
 *
 * An example
 * ==========
 *   #include <carvel.hpp>
 *   #include <iostream>
 *
 *   int main()
 *   {
 *       const std::vector<double> points = {
 *           0, 0, 0,  2, 0, 0,  2, 2, 0,  0, 2, 0,  1, 1, 2 };
 *       const std::vector<std::uint32_t> sizes = { 4, 3, 3, 3, 3 };
 *       const std::vector<std::uint32_t> corners = {
 *           3, 2, 1, 0,  0, 1, 4,  1, 2, 4,  2, 3, 4,  3, 0, 4 };
 *       try {
 *           const auto mesh = carvel::Mesh::create({ 5, sizes, corners });
 *           const auto scheme = carvel::Scheme::create({ CARVEL_SCHEME_THREE_POINT });
 *           const auto smooth = carvel::refine(mesh, scheme, 2, points);
 *           std::cout << smooth.face_sizes.size() << " faces\n";
 *       } catch (const carvel::Error &error) {
 *           std::cerr << error.what() << '\n';
 *           return 1;
 *       }
 *   }
 *
 *   c++ -std=c++17 pyramid.cpp $(pkg-config --cflags --libs carvel) -o pyramid
 *
 *
 * What holds for every function
 * =============================
 * Errors     come in two styles. create(...) throws carvel::Error;
 *            try_create(...) returns a Result<Mesh>, which holds a Mesh or a
 *            Failure. So for every function that can fail. Without exceptions
 *            (-fno-exceptions, or CARVEL_NO_EXCEPTIONS defined) only the second
 *            is there.
 *
 * Memory     Vectors are grown here, to the size that the library names. Where
 *            the system has no memory for one, std::bad_alloc is thrown, and a
 *            try_ function fails with CARVEL_STATUS_OUT_OF_RESOURCES. The
 *            functions named _into fill your buffers and allocate nothing that
 *            grows with the mesh.
 *
 * Contexts   are passed by pointer, last; nullptr is the calling thread alone.
 *
 * Threads    as in carvel.h: Mesh, Scheme, Hierarchy and Context may be used by
 *            any number of threads through const functions; a Refiner serves
 *            one call at a time; moving from or assigning to a handle is a write.
 *
 * Handles    own one C object, move and do not copy. One that was moved from or
 *            made by default is empty, and using it is answered by the library
 *            with CARVEL_STATUS_NULL_POINTER. get() lends the object to any
 *            function of carvel.h.
 *
 * Results    by value are yours; Span, ConstValues and Values are borrowed.
 */
#ifndef CARVEL_HPP
#define CARVEL_HPP

#if !(__cplusplus >= 201703L || (defined(_MSVC_LANG) && _MSVC_LANG >= 201703L))
#error "carvel.hpp needs C++17; carvel.h does with C++98"
#endif

#include <carvel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <iterator>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#if (defined(__cpp_exceptions) || defined(_CPPUNWIND)) && !defined(CARVEL_NO_EXCEPTIONS)
#define CARVEL_HPP_THROWS 1
#define CARVEL_HPP_STYLE throwing
#else
#define CARVEL_HPP_THROWS 0
#define CARVEL_HPP_STYLE non_throwing
#endif

namespace carvel {
/* Files compiled with and without exceptions may be linked together: the two
 * are different types to the linker. */
inline namespace CARVEL_HPP_STYLE {

/* Structs of carvel.h, under shorter names. */
using Bytes = carvel_bytes;
using Seconds = carvel_seconds;
using Counts = carvel_counts;
using MaskAnalysis = carvel_mask_analysis;
using ParameterRange = carvel_parameter_range;
using PolygonCounts = carvel_polygon_counts;
using Element = carvel_element;
using Fraction = carvel_fraction;
using HistogramEntry = carvel_histogram_entry;
using Origin = carvel_origin;
using StencilCounts = carvel_stencil_counts;
using Survey = carvel_survey;

/* The version of the library that is running, such as "0.1.0". */
inline const char *version() noexcept { return carvel_version(); }

/* The same as a number, like CARVEL_VERSION. */
inline std::uint32_t version_number() noexcept { return carvel_version_number(); }

/* ==========================================================================
 * Failure, Error, Result: why a call failed
 * ========================================================================== */

/* One thing that was wrong: see carvel_error_entry_status and its neighbours. */
struct Entry {
    carvel_status status = CARVEL_STATUS_OK;
    std::string message;
    std::vector<Element> elements;
};

/* Why a call failed. Copies share the C error: entries() of copies of one
 * failure may be called by one thread at a time. */
class Failure {
public:
    /* A failure of your own making, for code that returns Result too. */
    Failure(carvel_status status, std::string message, std::vector<Element> elements = {})
        : own_{status, std::move(message), std::move(elements)}
    {
    }

    /* Takes over what a C function has written to `error`. */
    Failure(carvel_status status, std::shared_ptr<carvel_error> error)
        : own_{status, carvel_error_message(error.get()), {}}, error_(std::move(error))
    {
    }

    /* One of enum carvel_status_code. */
    carvel_status status() const noexcept { return own_.status; }

    /* One line for people, UTF-8, naming elements. */
    const std::string &message() const noexcept { return own_.message; }

    /* Every defect of a mesh that was refused, otherwise the failure itself;
     * built when asked for. */
    std::vector<Entry> entries() const
    {
        std::vector<Entry> entries;
        if (!error_) {
            entries.push_back(own_);
            return entries;
        }
        const std::uint64_t count = carvel_error_entry_count(error_.get());
        entries.reserve(static_cast<std::size_t>(count));
        for (std::uint64_t i = 0; i < count; ++i)
            entries.push_back(entry(i));
        return entries;
    }

    /* What a progress function threw, if that is what ended the call. */
    const std::exception_ptr &exception() const noexcept { return exception_; }

    /* A failed allocation of this layer. */
    static Failure no_memory()
    {
        Failure failure(CARVEL_STATUS_OUT_OF_RESOURCES, "no memory for the result");
        failure.allocation_ = true;
        return failure;
    }

    /* A call ended by an exception of a progress function. */
    static Failure thrown(std::exception_ptr exception)
    {
        Failure failure(CARVEL_STATUS_CANCELLED, "the progress function threw an exception");
        failure.exception_ = std::move(exception);
        return failure;
    }

#if CARVEL_HPP_THROWS
    /* Throws the failure: what a progress function threw, std::bad_alloc, or
     * Error. */
    [[noreturn]] void raise() const;
#endif

private:
    Entry entry(std::uint64_t i) const
    {
        Entry entry;
        entry.status = carvel_error_entry_status(error_.get(), i);
        entry.message = carvel_error_entry_message(error_.get(), i);
        const std::uint64_t count = carvel_error_element_count(error_.get(), i);
        entry.elements.reserve(static_cast<std::size_t>(count));
        for (std::uint64_t j = 0; j < count; ++j)
            entry.elements.push_back(carvel_error_element(error_.get(), i, j));
        return entry;
    }

    Entry own_;
    std::shared_ptr<carvel_error> error_;
    std::exception_ptr exception_;
    bool allocation_ = false;
};

#if CARVEL_HPP_THROWS
/* What the throwing functions throw; what() is the message. */
class Error : public std::runtime_error {
public:
    explicit Error(const Failure &failure)
        : std::runtime_error(failure.message()),
          failure_(std::make_shared<const Failure>(failure))
    {
    }

    /* One of enum carvel_status_code. */
    carvel_status status() const noexcept { return failure_->status(); }

    /* Every defect of a mesh that was refused, otherwise the failure itself. */
    std::vector<Entry> entries() const { return failure_->entries(); }

    const Failure &failure() const noexcept { return *failure_; }

private:
    std::shared_ptr<const Failure> failure_;
};

inline void Failure::raise() const
{
    if (exception_)
        std::rethrow_exception(exception_);
    if (allocation_)
        throw std::bad_alloc();
    throw Error(*this);
}
#endif

/* A value or a Failure. Ask before you take: *result without a value is
 * undefined, as with std::optional; value() throws instead. */
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    Result(Failure failure) : content_(std::in_place_index<1>, std::move(failure)) {}

    bool has_value() const noexcept { return content_.index() == 0; }
    explicit operator bool() const noexcept { return has_value(); }

    T &operator*() & noexcept { return *std::get_if<0>(&content_); }
    const T &operator*() const & noexcept { return *std::get_if<0>(&content_); }
    T &&operator*() && noexcept { return std::move(*std::get_if<0>(&content_)); }
    T *operator->() noexcept { return std::get_if<0>(&content_); }
    const T *operator->() const noexcept { return std::get_if<0>(&content_); }

    /* Only where there is no value. */
    const Failure &error() const noexcept { return *std::get_if<1>(&content_); }

#if CARVEL_HPP_THROWS
    /* The value, or Failure::raise(). */
    T value() &&
    {
        if (!has_value())
            error().raise();
        return std::move(**this);
    }
#endif

private:
    std::variant<T, Failure> content_;
};

/* Success or a Failure. */
template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Failure failure) : content_(std::in_place_index<1>, std::move(failure)) {}

    bool has_value() const noexcept { return content_.index() == 0; }
    explicit operator bool() const noexcept { return has_value(); }

    /* Only after a failure. */
    const Failure &error() const noexcept { return *std::get_if<1>(&content_); }

#if CARVEL_HPP_THROWS
    void value() const
    {
        if (!has_value())
            error().raise();
    }
#endif

private:
    std::variant<std::monostate, Failure> content_;
};

/* ==========================================================================
 * Span, ConstValues, Values: arrays of yours
 * ========================================================================== */

/* A pointer and a count, borrowed: of a C array, or of anything with data() and
 * size() such as std::vector, std::array and std::span, to which it converts. */
template <class T>
class Span {
public:
    using element_type = T;
    using value_type = std::remove_cv_t<T>;

    constexpr Span() noexcept = default;
    constexpr Span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}

    template <class C, class = std::enable_if_t<std::is_convertible_v<
                           std::remove_pointer_t<decltype(std::data(std::declval<C &>()))> (*)[],
                           T (*)[]>>>
    constexpr Span(C &&container) noexcept
        : data_(std::data(container)), size_(std::size(container))
    {
    }

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t i) const noexcept { return data_[i]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/* Signed indices as carvel reads them; a negative one is out of range. */
inline Span<const std::uint32_t> as_unsigned(Span<const std::int32_t> indices) noexcept
{
    return {reinterpret_cast<const std::uint32_t *>(indices.data()), indices.size()};
}

namespace detail {

template <class T>
struct Layouts;

template <>
struct Layouts<float> {
    using ConstValues = carvel_const_values_f32;
    using Values = carvel_values_f32;
    using ChannelInput = carvel_channel_input_f32;
    using ChannelOutput = carvel_channel_output_f32;
    using Input = carvel_refine_input_f32;
    using Output = carvel_refine_output_f32;
};

template <>
struct Layouts<double> {
    using ConstValues = carvel_const_values_f64;
    using Values = carvel_values_f64;
    using ChannelInput = carvel_channel_input_f64;
    using ChannelOutput = carvel_channel_output_f64;
    using Input = carvel_refine_input_f64;
    using Output = carvel_refine_output_f64;
};

} // namespace detail

/* Values to write, float or double: `count` records of `width` values, `stride`
 * bytes from one to the next, 0 for no gap. It is the C struct. */
template <class T>
struct Values : detail::Layouts<T>::Values {
    Values() noexcept : detail::Layouts<T>::Values{nullptr, 0, 0, 0} {}
    Values(T *first, std::uint64_t records, std::uint64_t values_each = 3,
           std::uint64_t step = 0) noexcept
        : detail::Layouts<T>::Values{first, records, values_each, step}
    {
    }
};

/* Values to read: the same. */
template <class T>
struct ConstValues : detail::Layouts<T>::ConstValues {
    ConstValues() noexcept : detail::Layouts<T>::ConstValues{nullptr, 0, 0, 0} {}
    ConstValues(const T *first, std::uint64_t records, std::uint64_t values_each = 3,
                std::uint64_t step = 0) noexcept
        : detail::Layouts<T>::ConstValues{first, records, values_each, step}
    {
    }
    ConstValues(const Values<T> &v) noexcept : ConstValues(v.data, v.count, v.width, v.stride) {}
};

namespace detail {

/* Scalars, std::array and C arrays of them: the value and how many. */
template <class R>
struct Record {
    using Value = R;
    static constexpr std::size_t width = 0;
};

template <class T, std::size_t N>
struct Record<T[N]> {
    using Value = T;
    static constexpr std::size_t width = N;
};

template <class T, std::size_t N>
struct Record<std::array<T, N>> {
    using Value = T;
    static constexpr std::size_t width = N;
};

template <class T>
constexpr bool is_value = std::is_same_v<T, float> || std::is_same_v<T, double>;

template <class M, class = void>
struct IsMatrix : std::false_type {};

template <class M>
struct IsMatrix<M, std::void_t<typename M::Scalar, decltype(M::IsRowMajor)>> : std::true_type {};

/* ConstValues or Values, as the pointer says. */
template <class T>
ConstValues<T> view(const T *data, std::size_t count, std::size_t width, std::size_t stride)
{
    static_assert(is_value<T>, "carvel: values are float or double");
    return {data, count, width, stride};
}

template <class T>
Values<T> view(T *data, std::size_t count, std::size_t width, std::size_t stride)
{
    static_assert(is_value<T>, "carvel: values are float or double");
    return {data, count, width, stride};
}

template <class T>
using Pointed = std::remove_reference_t<decltype(*std::data(std::declval<T &>()))>;

} // namespace detail

/* Values that are described already. */
template <class T>
ConstValues<T> values(const ConstValues<T> &v)
{
    return v;
}

template <class T>
Values<T> values(const Values<T> &v)
{
    return v;
}

/* `count` records that begin at a pointer; ConstValues<T> and Values<T> take the
 * same arguments. A C array is a container, below. */
template <class P, class = std::enable_if_t<std::is_pointer_v<std::decay_t<P>> &&
                                            !std::is_array_v<std::remove_reference_t<P>>>>
auto values(P &&data, std::size_t count, std::size_t width = 3, std::size_t stride = 0)
{
    return detail::view(data, count, width, stride);
}

/* The content of a container:
 *   of float or double, `width` values a record. A container that does not
 *   divide into records is handed over as none, and refused for that;
 *   of std::array or C arrays of float or double, one record each.
 * Values if it can be written to, otherwise ConstValues. */
template <class C, class = std::enable_if_t<!detail::IsMatrix<std::decay_t<C>>::value>,
          class E = detail::Pointed<C>>
auto values(C &&container, std::size_t width = 3)
{
    using R = detail::Record<std::remove_cv_t<E>>;
    const std::size_t size = std::size(container);
    if constexpr (R::width == 0) {
        const std::size_t count = width != 0 && size % width == 0 ? size / width : 0;
        return detail::view(std::data(container), count, width, 0);
    } else {
        using V = std::conditional_t<std::is_const_v<E>, const typename R::Value,
                                     typename R::Value>;
        static_cast<void>(width);
        return detail::view(reinterpret_cast<V *>(std::data(container)), size, R::width, 0);
    }
}

/* A member of every struct in a container:
 *   values(vertices, &Vertex::position)   an array, std::array or C array;
 *   values(vertices, &Vertex::x, 3)       a number and those that follow it. */
template <class C, class S, class M>
auto values(C &&container, M S::*member, std::size_t width = 1)
{
    using R = detail::Record<M>;
    using E = detail::Pointed<C>;
    static_assert(std::is_standard_layout_v<S>, "carvel: a struct of standard layout is needed");
    using V = std::conditional_t<std::is_const_v<E>, const typename R::Value, typename R::Value>;
    const std::size_t size = std::size(container);
    V *const first =
        size == 0 ? nullptr : reinterpret_cast<V *>(&(std::data(container)->*member));
    return detail::view(first, size, R::width == 0 ? width : R::width, sizeof(S));
}

template <class M, class = std::enable_if_t<detail::IsMatrix<std::decay_t<M>>::value>,
          class Never = void>
void values(M &&, std::size_t = 3)
{
    static_assert(!std::is_void_v<Never>,
                  "carvel: say whether the records are rows(matrix) or columns(matrix)");
}

/* A matrix of Eigen, or like one: every row a record. It must be stored by rows,
 * or have one column. */
template <class M>
auto rows(M &&matrix)
{
    using Type = std::decay_t<M>;
    static_assert(Type::IsRowMajor || Type::ColsAtCompileTime == 1,
                  "carvel: rows of a column-major matrix do not lie together; store the matrix "
                  "row-major, or as its transpose and use columns()");
    static_assert(!Type::IsRowMajor || Type::InnerStrideAtCompileTime == 1,
                  "carvel: the values of a row must lie together");
    const auto step = Type::IsRowMajor ? matrix.outerStride() : matrix.innerStride();
    return detail::view(matrix.data(), static_cast<std::size_t>(matrix.rows()),
                        static_cast<std::size_t>(matrix.cols()),
                        static_cast<std::size_t>(step) * sizeof(typename Type::Scalar));
}

/* The same: every column a record. It must be stored by columns, Eigen's
 * default, or have one row. */
template <class M>
auto columns(M &&matrix)
{
    using Type = std::decay_t<M>;
    static_assert(!Type::IsRowMajor || Type::RowsAtCompileTime == 1,
                  "carvel: columns of a row-major matrix do not lie together; store the matrix "
                  "column-major, or as its transpose and use rows()");
    static_assert(Type::IsRowMajor || Type::InnerStrideAtCompileTime == 1,
                  "carvel: the values of a column must lie together");
    const auto step = Type::IsRowMajor ? matrix.innerStride() : matrix.outerStride();
    return detail::view(matrix.data(), static_cast<std::size_t>(matrix.cols()),
                        static_cast<std::size_t>(matrix.rows()),
                        static_cast<std::size_t>(step) * sizeof(typename Type::Scalar));
}

namespace detail {

/* ==========================================================================
 * What every call does
 * ========================================================================== */

/* One call of a function of carvel.h: its error, the room for its results, and
 * what a progress function throws meanwhile on this thread. */
class Call {
public:
    Call()
    {
        carvel_error *error = nullptr;
        carvel_error_create(&error);
        error_.reset(error, carvel_error_destroy);
        /* Last: what throws above leaves no trace. */
        outer_ = std::exchange(current(), this);
    }
    ~Call() { current() = outer_; }
    Call(const Call &) = delete;
    Call &operator=(const Call &) = delete;

    /* The last argument of the C function, and what it returned. */
    carvel_error *error() const noexcept { return error_.get(); }
    carvel_status status = CARVEL_STATUS_OK;

    /* Gives a vector a size, or notes that there is no memory. Tried out before
     * it is done, so that it works without exceptions too. */
    template <class T>
    bool grow(std::vector<T> &vector, std::uint64_t size, std::uint64_t factor = 1)
    {
        if (factor == 0)
            size = 0;
        const std::uint64_t most =
            static_cast<std::uint64_t>(vector.max_size()) / (factor == 0 ? 1 : factor);
        void *probe = nullptr;
        if (size <= most)
            probe = ::operator new(static_cast<std::size_t>(size * factor) * sizeof(T),
                                   std::nothrow);
        no_memory_ = probe == nullptr;
        ::operator delete(probe);
        if (!no_memory_)
            vector.resize(static_cast<std::size_t>(size * factor));
        return !no_memory_;
    }

    /* Keeps the exception being handled until the call has returned. */
    static void keep_exception() noexcept
    {
        if (Call *const call = current())
            call->exception_ = std::current_exception();
    }

    template <class T>
    Result<T> result(T value) const
    {
        if (failed())
            return failure();
        return Result<T>(std::move(value));
    }

    Result<void> result() const
    {
        if (failed())
            return failure();
        return {};
    }

private:
    bool failed() const { return status != CARVEL_STATUS_OK || no_memory_ || exception_; }

    Failure failure() const
    {
        if (exception_)
            return Failure::thrown(exception_);
        return no_memory_ ? Failure::no_memory() : Failure(status, error_);
    }

    static Call *&current() noexcept
    {
        thread_local Call *call = nullptr;
        return call;
    }

    std::shared_ptr<carvel_error> error_;
    std::exception_ptr exception_;
    Call *outer_ = nullptr;
    bool no_memory_ = false;
};

/* A struct of carvel.h with its size. */
template <class T>
T sized() noexcept
{
    T t{};
    t.struct_size = static_cast<std::uint32_t>(sizeof(T));
    return t;
}

/* Owns one object of carvel.h. */
template <class T, void (*Destroy)(T *)>
class Handle {
public:
    Handle() noexcept = default;
    /* Takes an object over. */
    explicit Handle(T *raw) noexcept : object_(raw) {}

    /* Lends the object. */
    T *get() const noexcept { return object_.get(); }
    explicit operator bool() const noexcept { return object_ != nullptr; }

private:
    struct Delete {
        void operator()(T *object) const noexcept { Destroy(object); }
    };

protected:
    std::unique_ptr<T, Delete> object_;
};

/* The destroy functions as constants, which those of a DLL are not. */
inline void destroy(carvel_context *object) { carvel_context_destroy(object); }
inline void destroy(carvel_scheme *object) { carvel_scheme_destroy(object); }
inline void destroy(carvel_mesh *object) { carvel_mesh_destroy(object); }
inline void destroy(carvel_channel *object) { carvel_channel_destroy(object); }
inline void destroy(carvel_refiner *object) { carvel_refiner_destroy(object); }
inline void destroy(carvel_hierarchy *object) { carvel_hierarchy_destroy(object); }
inline void destroy(carvel_stencils *object) { carvel_stencils_destroy(object); }
inline void destroy(carvel_surface *object) { carvel_surface_destroy(object); }
inline void destroy(carvel_search *object) { carvel_search_destroy(object); }
inline void destroy(carvel_tessellation *object) { carvel_tessellation_destroy(object); }
inline void destroy(carvel_mask *object) { carvel_mask_destroy(object); }
inline void destroy(carvel_grid_mask *object) { carvel_grid_mask_destroy(object); }

/* The twins by type. */
inline carvel_status refine(carvel_refiner *refiner, const carvel_context *context,
                            const carvel_refine_input_f32 *input,
                            carvel_refine_output_f32 *output, carvel_error *error)
{
    return carvel_refiner_refine_f32(refiner, context, input, output, error);
}
inline carvel_status refine(carvel_refiner *refiner, const carvel_context *context,
                            const carvel_refine_input_f64 *input,
                            carvel_refine_output_f64 *output, carvel_error *error)
{
    return carvel_refiner_refine_f64(refiner, context, input, output, error);
}
/* Which of the operations on values. */
enum class Verb { apply, add, transpose };
inline carvel_status apply(Verb verb, const carvel_stencils *stencils,
                           const carvel_context *context, const carvel_const_values_f32 *values,
                           const carvel_values_f32 *out, carvel_error *error)
{
    const auto call = verb == Verb::apply ? carvel_stencils_apply_f32
                      : verb == Verb::add ? carvel_stencils_apply_add_f32
                                          : carvel_stencils_apply_transpose_f32;
    return call(stencils, context, values, out, error);
}
inline carvel_status apply(Verb verb, const carvel_stencils *stencils,
                           const carvel_context *context, const carvel_const_values_f64 *values,
                           const carvel_values_f64 *out, carvel_error *error)
{
    const auto call = verb == Verb::apply ? carvel_stencils_apply_f64
                      : verb == Verb::add ? carvel_stencils_apply_add_f64
                                          : carvel_stencils_apply_transpose_f64;
    return call(stencils, context, values, out, error);
}
inline carvel_status update(const carvel_stencils *stencils, const carvel_context *context,
                            const std::uint32_t *changed, std::uint64_t count,
                            const carvel_const_values_f32 *values, const carvel_values_f32 *out,
                            carvel_error *error)
{
    return carvel_stencils_update_f32(stencils, context, changed, count, values, out, error);
}
inline carvel_status update(const carvel_stencils *stencils, const carvel_context *context,
                            const std::uint32_t *changed, std::uint64_t count,
                            const carvel_const_values_f64 *values, const carvel_values_f64 *out,
                            carvel_error *error)
{
    return carvel_stencils_update_f64(stencils, context, changed, count, values, out, error);
}
inline carvel_status csr(const carvel_stencils *stencils, std::uint64_t *offsets,
                         std::uint64_t rows, std::uint32_t *indices, float *weights,
                         std::uint64_t entries, carvel_error *error)
{
    return carvel_stencils_csr_f32(stencils, offsets, rows, indices, weights, entries, error);
}
inline carvel_status csr(const carvel_stencils *stencils, std::uint64_t *offsets,
                         std::uint64_t rows, std::uint32_t *indices, double *weights,
                         std::uint64_t entries, carvel_error *error)
{
    return carvel_stencils_csr_f64(stencils, offsets, rows, indices, weights, entries, error);
}
inline carvel_status evaluate(const carvel_surface *surface, const carvel_context *context,
                              const carvel_sample *samples, std::uint64_t count,
                              carvel_derivatives derivatives,
                              const carvel_const_values_f32 *values, const carvel_values_f32 *out,
                              carvel_error *error)
{
    return carvel_surface_evaluate_f32(surface, context, samples, count,
                                       static_cast<std::int32_t>(derivatives), values, out, error);
}
inline carvel_status evaluate(const carvel_surface *surface, const carvel_context *context,
                              const carvel_sample *samples, std::uint64_t count,
                              carvel_derivatives derivatives,
                              const carvel_const_values_f64 *values, const carvel_values_f64 *out,
                              carvel_error *error)
{
    return carvel_surface_evaluate_f64(surface, context, samples, count,
                                       static_cast<std::int32_t>(derivatives), values, out, error);
}
inline carvel_status search(const carvel_context *context, const carvel_surface *surface,
                            const carvel_const_values_f32 *positions, carvel_search **out,
                            carvel_error *error)
{
    return carvel_search_create_f32(context, surface, positions, out, error);
}
inline carvel_status search(const carvel_context *context, const carvel_surface *surface,
                            const carvel_const_values_f64 *positions, carvel_search **out,
                            carvel_error *error)
{
    return carvel_search_create_f64(context, surface, positions, out, error);
}
inline carvel_status tessellate(const carvel_context *context, const carvel_surface *surface,
                                const carvel_const_values_f32 *positions,
                                const carvel_tessellation_desc *desc, carvel_tessellation **out,
                                carvel_error *error)
{
    return carvel_tessellation_create_f32(context, surface, positions, desc, out, error);
}
inline carvel_status tessellate(const carvel_context *context, const carvel_surface *surface,
                                const carvel_const_values_f64 *positions,
                                const carvel_tessellation_desc *desc, carvel_tessellation **out,
                                carvel_error *error)
{
    return carvel_tessellation_create_f64(context, surface, positions, desc, out, error);
}
inline carvel_status positions(const carvel_tessellation *tessellation,
                               const carvel_values_f32 *out, carvel_error *error)
{
    return carvel_tessellation_positions_f32(tessellation, out, error);
}
inline carvel_status positions(const carvel_tessellation *tessellation,
                               const carvel_values_f64 *out, carvel_error *error)
{
    return carvel_tessellation_positions_f64(tessellation, out, error);
}
inline carvel_status normals(const carvel_tessellation *tessellation,
                             const carvel_values_f32 *out, carvel_error *error)
{
    return carvel_tessellation_normals_f32(tessellation, out, error);
}
inline carvel_status normals(const carvel_tessellation *tessellation,
                             const carvel_values_f64 *out, carvel_error *error)
{
    return carvel_tessellation_normals_f64(tessellation, out, error);
}
inline carvel_status refine(const carvel_mask *mask, const carvel_context *context,
                            carvel_ends ends, std::uint32_t steps,
                            const carvel_const_values_f32 *points, const carvel_values_f32 *out,
                            carvel_error *error)
{
    return carvel_mask_refine_f32(mask, context, static_cast<std::int32_t>(ends), steps, points,
                                  out, error);
}
inline carvel_status refine(const carvel_mask *mask, const carvel_context *context,
                            carvel_ends ends, std::uint32_t steps,
                            const carvel_const_values_f64 *points, const carvel_values_f64 *out,
                            carvel_error *error)
{
    return carvel_mask_refine_f64(mask, context, static_cast<std::int32_t>(ends), steps, points,
                                  out, error);
}
inline carvel_status limit(const carvel_mask *mask, const carvel_context *context,
                           carvel_ends ends, std::uint32_t derivative,
                           const carvel_const_values_f32 *points, const carvel_values_f32 *out,
                           carvel_error *error)
{
    return carvel_mask_limit_f32(mask, context, static_cast<std::int32_t>(ends), derivative,
                                 points, out, error);
}
inline carvel_status refine_grid(const carvel_mask *down, const carvel_mask *along,
                                 const carvel_context *context, carvel_ends ends_down,
                                 carvel_ends ends_along, std::uint64_t columns,
                                 std::uint32_t steps, const carvel_const_values_f32 *points,
                                 const carvel_values_f32 *out, carvel_error *error)
{
    return carvel_mask_refine_grid_f32(down, along, context, static_cast<std::int32_t>(ends_down),
                                       static_cast<std::int32_t>(ends_along), columns, steps,
                                       points, out, error);
}
inline carvel_status limit(const carvel_mask *mask, const carvel_context *context,
                           carvel_ends ends, std::uint32_t derivative,
                           const carvel_const_values_f64 *points, const carvel_values_f64 *out,
                           carvel_error *error)
{
    return carvel_mask_limit_f64(mask, context, static_cast<std::int32_t>(ends), derivative,
                                 points, out, error);
}
inline carvel_status refine_grid(const carvel_mask *down, const carvel_mask *along,
                                 const carvel_context *context, carvel_ends ends_down,
                                 carvel_ends ends_along, std::uint64_t columns,
                                 std::uint32_t steps, const carvel_const_values_f64 *points,
                                 const carvel_values_f64 *out, carvel_error *error)
{
    return carvel_mask_refine_grid_f64(down, along, context, static_cast<std::int32_t>(ends_down),
                                       static_cast<std::int32_t>(ends_along), columns, steps,
                                       points, out, error);
}
inline carvel_status refine_grid(const carvel_grid_mask *mask, const carvel_context *context,
                                 carvel_ends ends_down, carvel_ends ends_along,
                                 std::uint64_t columns, std::uint32_t steps,
                                 const carvel_const_values_f32 *points,
                                 const carvel_values_f32 *out, carvel_error *error)
{
    return carvel_grid_mask_refine_f32(mask, context, static_cast<std::int32_t>(ends_down),
                                       static_cast<std::int32_t>(ends_along), columns, steps,
                                       points, out, error);
}
inline carvel_status refine_grid(const carvel_grid_mask *mask, const carvel_context *context,
                                 carvel_ends ends_down, carvel_ends ends_along,
                                 std::uint64_t columns, std::uint32_t steps,
                                 const carvel_const_values_f64 *points,
                                 const carvel_values_f64 *out, carvel_error *error)
{
    return carvel_grid_mask_refine_f64(mask, context, static_cast<std::int32_t>(ends_down),
                                       static_cast<std::int32_t>(ends_along), columns, steps,
                                       points, out, error);
}
inline carvel_status interpolate(const carvel_hierarchy *hierarchy,
                                 const carvel_context *context, std::uint32_t level,
                                 carvel_interpolation interpolation,
                                 const carvel_const_values_f32 *values,
                                 const carvel_values_f32 *out, carvel_error *error)
{
    return carvel_hierarchy_interpolate_f32(
        hierarchy, context, level, static_cast<std::int32_t>(interpolation), values, out, error);
}
inline carvel_status interpolate(const carvel_hierarchy *hierarchy,
                                 const carvel_context *context, std::uint32_t level,
                                 carvel_interpolation interpolation,
                                 const carvel_const_values_f64 *values,
                                 const carvel_values_f64 *out, carvel_error *error)
{
    return carvel_hierarchy_interpolate_f64(
        hierarchy, context, level, static_cast<std::int32_t>(interpolation), values, out, error);
}

} // namespace detail

/* ==========================================================================
 * Context: threads, memory ceiling, progress, cancellation
 * ========================================================================== */

/* Told how much of a call is done, from 0 to 1, on the thread that made the
 * call; true cancels it. Two calls at once on one context call it at once. */
using Progress = std::function<bool(double)>;

struct ContextDesc {
    /* 0 for all cores, 1 for the calling thread alone. */
    std::uint32_t thread_count = 0;
    /* Bytes that a call of the library may need, the vectors that it fills not
     * counted; 0 for no ceiling. */
    std::uint64_t memory_ceiling = 0;
    /* May be empty. What it throws ends the call and is thrown by it once the
     * library has returned; from a try_ function it is Failure::exception(). */
    Progress progress = {};
};

/* Owns its threads and its progress function; worth keeping. An empty one is like
 * nullptr. It cannot be released: its C object calls a function that it owns. */
class Context : public detail::Handle<carvel_context, detail::destroy> {
public:
    using Handle::Handle;
    Context() noexcept = default;
    Context(Context &&) noexcept = default;
    /* The old threads end before the function that they may report to. */
    Context &operator=(Context &&other) noexcept
    {
        if (this != &other) {
            object_ = std::move(other.object_);
            progress_ = std::move(other.progress_);
        }
        return *this;
    }
    ~Context() { object_.reset(); }

    static Result<Context> try_create(ContextDesc desc = {})
    {
        detail::Call call;
        Context context;
        carvel_context_desc c = detail::sized<carvel_context_desc>();
        c.thread_count = desc.thread_count;
        c.memory_ceiling = desc.memory_ceiling;
        if (desc.progress) {
            context.progress_ = std::make_unique<Progress>(std::move(desc.progress));
            c.progress = report;
            c.user_data = context.progress_.get();
        }
        carvel_context *out = nullptr;
        call.status = carvel_context_create(&c, &out, call.error());
        context.object_.reset(out);
        return call.result(std::move(context));
    }

    /* 1 for an empty context. */
    std::uint32_t thread_count() const noexcept { return carvel_context_thread_count(get()); }

    /* Asks the calls running with this context to stop, and every later one
     * until reset(). Any thread, any time. */
    void cancel() const noexcept { carvel_context_cancel(get()); }
    void reset() const noexcept { carvel_context_reset(get()); }
    bool is_cancelled() const noexcept { return carvel_context_is_cancelled(get()) != 0; }

#if CARVEL_HPP_THROWS
    static Context create(ContextDesc desc = {}) { return try_create(std::move(desc)).value(); }
#endif

private:
    /* No exception may run into the library. */
    static std::int32_t report(double done, void *progress) noexcept
    {
#if CARVEL_HPP_THROWS
        try {
            return (*static_cast<Progress *>(progress))(done) ? 1 : 0;
        } catch (...) {
            detail::Call::keep_exception();
            return 1;
        }
#else
        return (*static_cast<Progress *>(progress))(done) ? 1 : 0;
#endif
    }

    std::unique_ptr<Progress> progress_;
};

namespace detail {

inline const carvel_context *raw(const Context *context) noexcept
{
    return context == nullptr ? nullptr : context->get();
}

} // namespace detail

/* ==========================================================================
 * Scheme: a subdivision scheme with its parameters
 * ========================================================================== */

/* carvel_scheme_desc, with the same defaults. */
struct SchemeDesc {
    carvel_scheme_family family = CARVEL_SCHEME_DOO_SABIN;
    carvel_corner_rule corner_rule = CARVEL_CORNER_RULE_COSINE;
    carvel_boundary boundary = CARVEL_BOUNDARY_EDGE_AND_CORNER;
    /* THREE_POINT only; 0/0 for 1/32. */
    Fraction w = {0, 0};
    /* B_SPLINE only. */
    std::uint64_t degree = 0;
    /* AVERAGING and PRIMAL only; read by create and not kept. */
    Span<const Fraction> passes = {};
    /* CATMULL_CLARK and LOOP only. */
    carvel_creasing creasing = CARVEL_CREASING_UNIFORM;
    /* CATMULL_CLARK only. */
    carvel_triangle_rule triangle_rule = CARVEL_TRIANGLE_RULE_CATMULL_CLARK;
    /* LOOP only. */
    carvel_loop_weights loop_weights = CARVEL_LOOP_WEIGHTS_LOOP;
    /* THREE_POINT only. */
    carvel_extraordinary extraordinary = CARVEL_EXTRAORDINARY_DEFAULT;
};

class Mesh;

class Scheme : public detail::Handle<carvel_scheme, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_scheme *release() noexcept { return object_.release(); }

    static Result<Scheme> try_create(const SchemeDesc &desc = {})
    {
        detail::Call call;
        carvel_scheme_desc c = detail::sized<carvel_scheme_desc>();
        c.family = static_cast<std::int32_t>(desc.family);
        c.corner_rule = static_cast<std::int32_t>(desc.corner_rule);
        c.boundary = static_cast<std::int32_t>(desc.boundary);
        c.w = desc.w;
        c.degree = desc.degree;
        c.passes = desc.passes.data();
        c.pass_count = desc.passes.size();
        c.creasing = static_cast<std::int32_t>(desc.creasing);
        c.triangle_rule = static_cast<std::int32_t>(desc.triangle_rule);
        c.loop_weights = static_cast<std::int32_t>(desc.loop_weights);
        c.extraordinary = static_cast<std::int32_t>(desc.extraordinary);
        carvel_scheme *out = nullptr;
        call.status = carvel_scheme_create(&c, &out, call.error());
        return call.result(Scheme(out));
    }

    /* The faces of a mesh, ascending in its own order, that are holes. */
    Result<std::vector<std::uint32_t>> try_holes(const Mesh &mesh) const;

    /* The smoothing passes that the scheme comes down to, in lowest terms. */
    Result<std::vector<Fraction>> try_passes() const
    {
        detail::Call call;
        std::vector<Fraction> out;
        std::uint64_t count = 0;
        call.status = carvel_scheme_passes(get(), nullptr, 0, &count, call.error());
        if (call.status == CARVEL_STATUS_OK && call.grow(out, count))
            call.status = carvel_scheme_passes(get(), out.data(), count, nullptr, call.error());
        return call.result(std::move(out));
    }

#if CARVEL_HPP_THROWS
    static Scheme create(const SchemeDesc &desc = {}) { return try_create(desc).value(); }
    std::vector<Fraction> passes() const { return try_passes().value(); }
    std::vector<std::uint32_t> holes(const Mesh &mesh) const { return try_holes(mesh).value(); }
#endif
};

/* ==========================================================================
 * Mesh: the topology of a mesh, checked
 * ========================================================================== */

/* Faces as you have them, in one of three layouts; borrowed, and read where they
 * are while a mesh is built. */
struct Faces {
    /* The size of every face, and the vertices of all. */
    Faces(std::uint64_t vertices, Span<const std::uint32_t> sizes,
          Span<const std::uint32_t> corners)
        : vertex_count(vertices), face_count(sizes.size()), face_sizes(sizes),
          face_vertices(corners)
    {
    }

    /* The first corner of every face and the number of corners: one more than
     * there are faces. */
    static Faces from_offsets(std::uint64_t vertices, Span<const std::uint32_t> offsets,
                              Span<const std::uint32_t> corners)
    {
        Faces faces(vertices, {}, corners);
        faces.face_count = offsets.empty() ? 0 : offsets.size() - 1;
        faces.face_offsets = offsets;
        return faces;
    }

    /* One size for all faces. */
    static Faces of_size(std::uint64_t vertices, std::uint32_t size,
                         Span<const std::uint32_t> corners)
    {
        Faces faces(vertices, {}, corners);
        faces.face_count = size == 0 ? 0 : corners.size() / size;
        faces.face_size = size;
        return faces;
    }

    std::uint64_t vertex_count;
    std::uint64_t face_count;
    std::uint32_t face_size = 0;
    Span<const std::uint32_t> face_sizes;
    Span<const std::uint32_t> face_offsets;
    Span<const std::uint32_t> face_vertices;
};

/* Arrays are read by create and not kept. */
struct MeshOptions {
    carvel_non_manifold non_manifold = CARVEL_NON_MANIFOLD_REFUSE;
    /* The faces are the result of a refinement that said so. */
    bool anchored = false;
    /* Boundary vertices to interpolate. */
    Span<const std::uint32_t> corner_tags = {};
    /* Creases: two vertices each, and the sharpness of each. */
    Span<const std::uint32_t> crease_vertices = {};
    Span<const float> crease_sharpness = {};
    /* Sharp vertices, and the sharpness of each. */
    Span<const std::uint32_t> sharp_vertices = {};
    Span<const float> vertex_sharpness = {};
    /* Faces that are refined but left out of what is drawn. */
    Span<const std::uint32_t> holes = {};
};

class Mesh : public detail::Handle<carvel_mesh, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_mesh *release() noexcept { return object_.release(); }

    static Result<Mesh> try_create(const Faces &faces, const MeshOptions &options = {},
                                   const Context *context = nullptr)
    {
        const bool pairs = options.crease_vertices.size() == 2 * options.crease_sharpness.size();
        if (!pairs || options.sharp_vertices.size() != options.vertex_sharpness.size())
            return Failure(CARVEL_STATUS_LENGTH_MISMATCH,
                           "a crease is two vertices and a sharpness, a sharp vertex one of each");
        detail::Call call;
        carvel_mesh_desc c = detail::sized<carvel_mesh_desc>();
        c.face_size = faces.face_size;
        c.vertex_count = faces.vertex_count;
        c.face_count = faces.face_count;
        c.face_sizes = faces.face_sizes.data();
        c.face_offsets = faces.face_offsets.data();
        c.face_vertices = faces.face_vertices.data();
        c.face_vertex_count = faces.face_vertices.size();
        c.non_manifold = static_cast<std::int32_t>(options.non_manifold);
        c.anchored = options.anchored ? 1 : 0;
        c.corner_tags = options.corner_tags.data();
        c.corner_tag_count = options.corner_tags.size();
        c.crease_vertices = options.crease_vertices.data();
        c.crease_sharpness = options.crease_sharpness.data();
        c.crease_count = options.crease_sharpness.size();
        c.sharp_vertices = options.sharp_vertices.data();
        c.vertex_sharpness = options.vertex_sharpness.data();
        c.sharp_vertex_count = options.sharp_vertices.size();
        c.holes = options.holes.data();
        c.hole_count = options.holes.size();
        carvel_mesh *out = nullptr;
        call.status = carvel_mesh_create(detail::raw(context), &c, &out, call.error());
        return call.result(Mesh(out));
    }

    Result<Counts> try_counts() const
    {
        detail::Call call;
        Counts counts = detail::sized<Counts>();
        call.status = carvel_mesh_counts(get(), &counts, call.error());
        return call.result(counts);
    }

    Result<Survey> try_survey() const
    {
        detail::Call call;
        Survey survey = detail::sized<Survey>();
        call.status = carvel_mesh_survey(get(), &survey, call.error());
        return call.result(survey);
    }

    Result<std::vector<HistogramEntry>> try_histogram(carvel_histogram which) const
    {
        detail::Call call;
        std::vector<HistogramEntry> out;
        std::uint64_t count = 0;
        const auto what = static_cast<std::int32_t>(which);
        call.status = carvel_mesh_histogram(get(), what, nullptr, 0, &count, call.error());
        if (call.status == CARVEL_STATUS_OK && call.grow(out, count))
            call.status =
                carvel_mesh_histogram(get(), what, out.data(), count, nullptr, call.error());
        return call.result(std::move(out));
    }

    /* The arrays of carvel_mesh_face_sizes and its neighbours. */
    using Indices = std::vector<std::uint32_t>;
    Result<Indices> try_face_sizes() const
    {
        return array<std::uint32_t>(carvel_mesh_face_sizes, &Counts::faces);
    }
    Result<Indices> try_face_offsets() const
    {
        return array<std::uint32_t>(carvel_mesh_face_offsets, &Counts::faces, 1, 1);
    }
    Result<Indices> try_face_vertices() const
    {
        return array<std::uint32_t>(carvel_mesh_face_vertices, &Counts::corners);
    }
    Result<Indices> try_edges() const
    {
        return array<std::uint32_t>(carvel_mesh_edges, &Counts::edges, 2);
    }
    Result<Indices> try_corner_edges() const
    {
        return array<std::uint32_t>(carvel_mesh_corner_edges, &Counts::corners);
    }
    Result<Indices> try_corner_twins() const
    {
        return array<std::uint32_t>(carvel_mesh_corner_twins, &Counts::corners);
    }
    Result<Indices> try_valences() const
    {
        return array<std::uint32_t>(carvel_mesh_valences, &Counts::vertices);
    }
    Result<std::vector<std::uint8_t>> try_boundary_flags() const
    {
        return array<std::uint8_t>(carvel_mesh_boundary_flags, &Counts::vertices);
    }
    Result<Indices> try_face_sources() const
    {
        return array<std::uint32_t>(carvel_mesh_face_sources, &Counts::faces);
    }
    Result<Indices> try_vertex_sources() const
    {
        return array<std::uint32_t>(carvel_mesh_vertex_sources, &Counts::vertices);
    }
    Result<Indices> try_corner_tags() const
    {
        return tags<std::uint32_t>(carvel_mesh_corner_tags, &Survey::corner_tags);
    }
    /* Two vertices for each crease. */
    Result<Indices> try_crease_vertices() const
    {
        return tags<std::uint32_t>(carvel_mesh_crease_vertices, &Survey::creases, 2);
    }
    Result<std::vector<float>> try_crease_sharpness() const
    {
        return tags<float>(carvel_mesh_crease_sharpness, &Survey::creases);
    }
    Result<Indices> try_sharp_vertices() const
    {
        return tags<std::uint32_t>(carvel_mesh_sharp_vertices, &Survey::sharp_vertices);
    }
    Result<std::vector<float>> try_vertex_sharpness() const
    {
        return tags<float>(carvel_mesh_vertex_sharpness, &Survey::sharp_vertices);
    }
    Result<Indices> try_holes() const
    {
        return tags<std::uint32_t>(carvel_mesh_holes, &Survey::holes);
    }

    /* False where CARVEL_NON_MANIFOLD_SHARPEN has kept what is not manifold. */
    bool is_manifold() const noexcept { return carvel_mesh_is_manifold(get()) != 0; }

    /* Checks every stored invariant. */
    Result<void> try_validate() const
    {
        detail::Call call;
        call.status = carvel_mesh_validate(get(), call.error());
        return call.result();
    }

#if CARVEL_HPP_THROWS
    static Mesh create(const Faces &faces, const MeshOptions &options = {},
                       const Context *context = nullptr)
    {
        return try_create(faces, options, context).value();
    }
    Counts counts() const { return try_counts().value(); }
    Survey survey() const { return try_survey().value(); }
    std::vector<HistogramEntry> histogram(carvel_histogram which) const
    {
        return try_histogram(which).value();
    }
    Indices face_sizes() const { return try_face_sizes().value(); }
    Indices face_offsets() const { return try_face_offsets().value(); }
    Indices face_vertices() const { return try_face_vertices().value(); }
    Indices edges() const { return try_edges().value(); }
    Indices corner_edges() const { return try_corner_edges().value(); }
    Indices corner_twins() const { return try_corner_twins().value(); }
    Indices valences() const { return try_valences().value(); }
    std::vector<std::uint8_t> boundary_flags() const { return try_boundary_flags().value(); }
    Indices face_sources() const { return try_face_sources().value(); }
    Indices vertex_sources() const { return try_vertex_sources().value(); }
    Indices corner_tags() const { return try_corner_tags().value(); }
    Indices crease_vertices() const { return try_crease_vertices().value(); }
    std::vector<float> crease_sharpness() const { return try_crease_sharpness().value(); }
    Indices sharp_vertices() const { return try_sharp_vertices().value(); }
    std::vector<float> vertex_sharpness() const { return try_vertex_sharpness().value(); }
    Indices holes() const { return try_holes().value(); }
    void validate() const { try_validate().value(); }
#endif

private:
    template <class T>
    using Getter = carvel_status (*)(const carvel_mesh *, T *, std::uint64_t, carvel_error *);

    template <class T>
    Result<std::vector<T>> array(Getter<T> getter, std::uint64_t Counts::*size,
                                 std::uint64_t factor = 1, std::uint64_t more = 0) const
    {
        const Result<Counts> counts = try_counts();
        if (!counts)
            return counts.error();
        return fill<T>(getter, (*counts).*size * factor + more);
    }

    template <class T>
    Result<std::vector<T>> tags(Getter<T> getter, std::uint64_t Survey::*size,
                                std::uint64_t factor = 1) const
    {
        const Result<Survey> survey = try_survey();
        if (!survey)
            return survey.error();
        return fill<T>(getter, (*survey).*size * factor);
    }

    template <class T>
    Result<std::vector<T>> fill(Getter<T> getter, std::uint64_t size) const
    {
        detail::Call call;
        std::vector<T> out;
        if (call.grow(out, size))
            call.status = getter(get(), out.data(), size, call.error());
        return call.result(std::move(out));
    }
};

inline Result<std::vector<std::uint32_t>> Scheme::try_holes(const Mesh &mesh) const
{
    detail::Call call;
    std::vector<std::uint32_t> out;
    std::uint64_t count = 0;
    call.status = carvel_scheme_holes(get(), mesh.get(), nullptr, 0, &count, call.error());
    if (call.status == CARVEL_STATUS_OK && call.grow(out, count))
        call.status =
            carvel_scheme_holes(get(), mesh.get(), out.data(), count, nullptr, call.error());
    return call.result(std::move(out));
}

/* ==========================================================================
 * Channel: values at the corners of a mesh's faces, with seams
 * ========================================================================== */

class Channel : public detail::Handle<carvel_channel, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_channel *release() noexcept { return object_.release(); }

    /* The value of every corner, in the order of the faces that the mesh was made of,
     * and how many values there are. */
    static Result<Channel> try_create(const Mesh &mesh, Span<const std::uint32_t> indices,
                                      std::uint64_t value_count,
                                      carvel_face_varying mode = CARVEL_FACE_VARYING_CORNERS)
    {
        detail::Call call;
        carvel_channel_desc c = detail::sized<carvel_channel_desc>();
        c.mode = static_cast<std::int32_t>(mode);
        c.indices = indices.data();
        c.index_count = indices.size();
        c.value_count = value_count;
        carvel_channel *out = nullptr;
        call.status = carvel_channel_create(mesh.get(), &c, &out, call.error());
        return call.result(Channel(out));
    }

    /* The number of edges inside the mesh that are seams. */
    std::uint64_t seam_edges() const noexcept { return carvel_channel_seam_edges(get()); }

#if CARVEL_HPP_THROWS
    static Channel create(const Mesh &mesh, Span<const std::uint32_t> indices,
                          std::uint64_t value_count,
                          carvel_face_varying mode = CARVEL_FACE_VARYING_CORNERS)
    {
        return try_create(mesh, indices, value_count, mode).value();
    }
#endif
};

/* ==========================================================================
 * Predictions: what a level will cost, before anything is built
 * ========================================================================== */

inline Result<Counts> try_predict_counts(const Mesh &mesh, const Scheme &scheme,
                                         std::uint32_t level)
{
    detail::Call call;
    Counts counts = detail::sized<Counts>();
    call.status = carvel_predict_counts(mesh.get(), scheme.get(), level, &counts, call.error());
    return call.result(counts);
}

/* width: values for each vertex, the 3 coordinates and all attributes together.
 * value_size: sizeof(float) or sizeof(double). */
inline Result<Bytes> try_predict_bytes(const Mesh &mesh, const Scheme &scheme,
                                       std::uint32_t level, std::uint32_t width,
                                       std::uint32_t value_size)
{
    detail::Call call;
    Bytes bytes = detail::sized<Bytes>();
    call.status = carvel_predict_bytes(mesh.get(), scheme.get(), level, width, value_size, &bytes,
                                       call.error());
    return call.result(bytes);
}

/* As try_predict_bytes; threads: of the context. */
inline Result<Seconds> try_predict_seconds(const Mesh &mesh, const Scheme &scheme,
                                           std::uint32_t level, std::uint32_t width,
                                           std::uint32_t value_size, std::uint32_t threads = 1)
{
    detail::Call call;
    Seconds seconds = detail::sized<Seconds>();
    call.status = carvel_predict_seconds(mesh.get(), scheme.get(), level, width, value_size,
                                         threads, &seconds, call.error());
    return call.result(seconds);
}

namespace detail {

inline Result<std::uint64_t> predict_channel(const carvel_channel *channel,
                                             const carvel_scheme *scheme, std::uint32_t level)
{
    Call call;
    std::uint64_t values = 0;
    call.status = carvel_predict_channel(channel, scheme, level, &values, call.error());
    return call.result(values);
}

} // namespace detail

/* The number of values that a channel has at a level. */
inline Result<std::uint64_t> try_predict_channel(const Channel &channel, const Scheme &scheme,
                                                 std::uint32_t level)
{
    return detail::predict_channel(channel.get(), scheme.get(), level);
}

#if CARVEL_HPP_THROWS
inline std::uint64_t predict_channel(const Channel &channel, const Scheme &scheme,
                                     std::uint32_t level)
{
    return try_predict_channel(channel, scheme, level).value();
}

inline Counts predict_counts(const Mesh &mesh, const Scheme &scheme, std::uint32_t level)
{
    return try_predict_counts(mesh, scheme, level).value();
}

inline Bytes predict_bytes(const Mesh &mesh, const Scheme &scheme, std::uint32_t level,
                           std::uint32_t width, std::uint32_t value_size)
{
    return try_predict_bytes(mesh, scheme, level, width, value_size).value();
}

inline Seconds predict_seconds(const Mesh &mesh, const Scheme &scheme, std::uint32_t level,
                               std::uint32_t width, std::uint32_t value_size,
                               std::uint32_t threads = 1)
{
    return try_predict_seconds(mesh, scheme, level, width, value_size, threads).value();
}
#endif

/* ==========================================================================
 * Refiner: one-shot, the faces and values of level n
 * ========================================================================== */

/* A channel and its values, a record for each. It is the C struct. */
template <class T>
struct ChannelInput : detail::Layouts<T>::ChannelInput {
    ChannelInput(const Channel &of, const ConstValues<T> &records) noexcept
        : detail::Layouts<T>::ChannelInput{of.get(), records}
    {
    }
};

/* Where they go: the value of every corner, and the values. It is the C struct. */
template <class T>
struct ChannelOutput : detail::Layouts<T>::ChannelOutput {
    ChannelOutput(Span<std::uint32_t> corners, const Values<T> &records) noexcept
        : detail::Layouts<T>::ChannelOutput{{corners.data(), corners.size()}, records}
    {
    }
};

/* What to refine; borrowed. */
template <class T>
struct RefineInput {
    const Mesh &mesh;
    const Scheme &scheme;
    /* Steps; 0 copies the input. */
    std::uint32_t levels;
    /* xyz of every vertex. */
    ConstValues<T> positions;
    /* Further values on vertices. */
    Span<const ConstValues<T>> attributes = {};
    /* One of enum carvel_interpolation for each attribute; empty for the scheme's
     * own rows for all. */
    Span<const std::int32_t> interpolations = {};
    /* Values at the corners of faces. */
    Span<const ChannelInput<T>> channels = {};
};

/* Where the result goes, in sizes of predict_counts; index arrays may be empty
 * and are not written then. */
template <class T>
struct RefineOutput {
    /* `faces`; `faces` + 1; `corners`; `faces`. */
    Span<std::uint32_t> face_sizes = {};
    Span<std::uint32_t> face_offsets = {};
    Span<std::uint32_t> face_vertices = {};
    Span<std::uint32_t> face_sources = {};
    /* `vertices` records of 3, and of each attribute's width. */
    Values<T> positions = {};
    Span<const Values<T>> attributes = {};
    /* One for each channel of the input, in sizes of predict_channel. */
    Span<const ChannelOutput<T>> channels = {};
    /* Set by the call: for MeshOptions::anchored, if these faces become a mesh. */
    bool anchored = false;
};

/* Refined values of a channel. */
template <class T>
struct RefinedChannel {
    /* The value of every corner. */
    std::vector<std::uint32_t> indices;
    std::vector<T> values;
};

/* A refined mesh in vectors. */
template <class T>
struct Refined {
    std::vector<std::uint32_t> face_sizes;
    std::vector<std::uint32_t> face_vertices;
    /* The control face, in Mesh's order, that each face descends from. */
    std::vector<std::uint32_t> face_sources;
    /* xyz of every vertex. */
    std::vector<T> positions;
    /* One for each attribute of the input. */
    std::vector<std::vector<T>> attributes;
    /* One for each channel of the input. */
    std::vector<RefinedChannel<T>> channels;
    /* For MeshOptions::anchored, if these faces become a mesh. */
    bool anchored = false;

    std::size_t vertex_count() const noexcept { return positions.size() / 3; }
    std::size_t face_count() const noexcept { return face_sizes.size(); }
};

/* Keeps its scratch memory from call to call: make one and use it again. */
class Refiner : public detail::Handle<carvel_refiner, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_refiner *release() noexcept { return object_.release(); }

    static Result<Refiner> try_create()
    {
        detail::Call call;
        carvel_refiner *out = nullptr;
        call.status = carvel_refiner_create(&out, call.error());
        return call.result(Refiner(out));
    }

    /* Bytes of scratch memory held. */
    std::uint64_t bytes() const noexcept { return carvel_refiner_bytes(get()); }

    /* Into your buffers, as carvel_refiner_refine_f32 and _f64. */
    template <class T>
    Result<void> try_refine_into(const RefineInput<T> &input, RefineOutput<T> &output,
                                 const Context *context = nullptr)
    {
        using C = detail::Layouts<T>;
        static_assert(sizeof(ConstValues<T>) == sizeof(typename C::ConstValues) &&
                          sizeof(Values<T>) == sizeof(typename C::Values) &&
                          sizeof(ChannelInput<T>) == sizeof(typename C::ChannelInput) &&
                          sizeof(ChannelOutput<T>) == sizeof(typename C::ChannelOutput),
                      "carvel: arrays of these are arrays of the C structs");
        if (!input.interpolations.empty() &&
            input.interpolations.size() != input.attributes.size())
            return Failure(CARVEL_STATUS_LENGTH_MISMATCH,
                           "there is not one interpolation for each attribute");
        detail::Call call;
        auto in = detail::sized<typename C::Input>();
        in.levels = input.levels;
        in.mesh = input.mesh.get();
        in.scheme = input.scheme.get();
        in.positions = input.positions;
        in.attributes = input.attributes.data();
        in.attribute_count = input.attributes.size();
        in.interpolations = input.interpolations.data();
        in.channels = input.channels.data();
        in.channel_count = input.channels.size();
        auto out = detail::sized<typename C::Output>();
        out.face_sizes = {output.face_sizes.data(), output.face_sizes.size()};
        out.face_offsets = {output.face_offsets.data(), output.face_offsets.size()};
        out.face_vertices = {output.face_vertices.data(), output.face_vertices.size()};
        out.face_sources = {output.face_sources.data(), output.face_sources.size()};
        out.positions = output.positions;
        out.attributes = output.attributes.data();
        out.attribute_count = output.attributes.size();
        out.channels = output.channels.data();
        out.channel_count = output.channels.size();
        call.status = detail::refine(get(), detail::raw(context), &in, &out, call.error());
        output.anchored = out.anchored != 0;
        return call.result();
    }

    /* Into vectors. */
    template <class T>
    Result<Refined<T>> try_refine(const RefineInput<T> &input, const Context *context = nullptr)
    {
        const Result<Counts> counts = try_predict_counts(input.mesh, input.scheme, input.levels);
        if (!counts)
            return counts.error();
        /* What the library would refuse is refused before vectors are made. */
        const Result<void> tried = try_without_room(input, context);
        if (!tried && tried.error().status() != CARVEL_STATUS_BUFFER_TOO_SMALL)
            return tried.error();
        Refined<T> refined;
        detail::Call call;
        bool room = call.grow(refined.face_sizes, counts->faces) &&
                    call.grow(refined.face_vertices, counts->corners) &&
                    call.grow(refined.face_sources, counts->faces) &&
                    call.grow(refined.positions, counts->vertices, 3);
        std::vector<Values<T>> attributes;
        for (const ConstValues<T> &attribute : input.attributes) {
            std::vector<T> &own = refined.attributes.emplace_back();
            room = room && call.grow(own, counts->vertices, attribute.width);
            attributes.emplace_back(own.data(), counts->vertices, attribute.width);
        }
        std::vector<ChannelOutput<T>> channels;
        for (const ChannelInput<T> &channel : input.channels) {
            const Result<std::uint64_t> size =
                detail::predict_channel(channel.channel, input.scheme.get(), input.levels);
            if (!size)
                return size.error();
            RefinedChannel<T> &own = refined.channels.emplace_back();
            room = room && call.grow(own.indices, counts->corners) &&
                   call.grow(own.values, *size, channel.values.width);
            channels.emplace_back(own.indices,
                                  Values<T>(own.values.data(), *size, channel.values.width));
        }
        if (!room)
            return call.result(std::move(refined));
        RefineOutput<T> output;
        output.face_sizes = refined.face_sizes;
        output.face_vertices = refined.face_vertices;
        output.face_sources = refined.face_sources;
        output.positions = values(refined.positions);
        output.attributes = attributes;
        output.channels = channels;
        const Result<void> done = try_refine_into(input, output, context);
        if (!done)
            return done.error();
        refined.anchored = output.anchored;
        return refined;
    }

    /* The same for positions alone: of anything that values() takes, or what
     * values(), rows() and columns() give. */
    template <class P>
    auto try_refine(const Mesh &mesh, const Scheme &scheme, std::uint32_t levels,
                    const P &positions, const Context *context = nullptr)
    {
        return try_refine(input(mesh, scheme, levels, ConstValues(values(positions))), context);
    }

#if CARVEL_HPP_THROWS
    static Refiner create() { return try_create().value(); }

    template <class T>
    void refine_into(const RefineInput<T> &input, RefineOutput<T> &output,
                     const Context *context = nullptr)
    {
        try_refine_into(input, output, context).value();
    }

    template <class T>
    Refined<T> refine(const RefineInput<T> &input, const Context *context = nullptr)
    {
        return try_refine(input, context).value();
    }

    template <class P>
    auto refine(const Mesh &mesh, const Scheme &scheme, std::uint32_t levels, const P &positions,
                const Context *context = nullptr)
    {
        return try_refine(mesh, scheme, levels, positions, context).value();
    }
#endif

private:
    /* A call without buffers, but with their widths. */
    template <class T>
    Result<void> try_without_room(const RefineInput<T> &input, const Context *context)
    {
        std::vector<Values<T>> attributes;
        for (const ConstValues<T> &attribute : input.attributes)
            attributes.emplace_back(nullptr, 0, attribute.width);
        std::vector<ChannelOutput<T>> channels;
        for (const ChannelInput<T> &channel : input.channels)
            channels.emplace_back(Span<std::uint32_t>(),
                                  Values<T>(nullptr, 0, channel.values.width));
        RefineOutput<T> nowhere;
        nowhere.positions = Values<T>(nullptr, 0);
        nowhere.attributes = attributes;
        nowhere.channels = channels;
        return try_refine_into(input, nowhere, context);
    }

    template <class T>
    static RefineInput<T> input(const Mesh &mesh, const Scheme &scheme, std::uint32_t levels,
                                const ConstValues<T> &positions)
    {
        return {mesh, scheme, levels, positions};
    }
};

/* In one call, with a refiner of its own: see Refiner::refine. */
template <class T>
Result<Refined<T>> try_refine(const RefineInput<T> &input, const Context *context = nullptr)
{
    Result<Refiner> refiner = Refiner::try_create();
    return refiner ? refiner->try_refine(input, context) : Result<Refined<T>>(refiner.error());
}

template <class P>
auto try_refine(const Mesh &mesh, const Scheme &scheme, std::uint32_t levels, const P &positions,
                const Context *context = nullptr)
{
    Result<Refiner> refiner = Refiner::try_create();
    using R = decltype(refiner->try_refine(mesh, scheme, levels, positions, context));
    return refiner ? refiner->try_refine(mesh, scheme, levels, positions, context)
                   : R(refiner.error());
}

#if CARVEL_HPP_THROWS
template <class T>
Refined<T> refine(const RefineInput<T> &input, const Context *context = nullptr)
{
    return try_refine(input, context).value();
}

template <class P>
auto refine(const Mesh &mesh, const Scheme &scheme, std::uint32_t levels, const P &positions,
            const Context *context = nullptr)
{
    return try_refine(mesh, scheme, levels, positions, context).value();
}
#endif

/* ==========================================================================
 * Hierarchy: all levels, kept
 * ========================================================================== */

/* A sparse matrix in CSR form: carvel_hierarchy_rows, which is experimental. */
struct Rows {
    std::vector<std::uint64_t> offsets;
    std::vector<std::uint32_t> indices;
    std::vector<double> weights;
};

/* Topology once, values as often as wanted. */
class Hierarchy : public detail::Handle<carvel_hierarchy, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_hierarchy *release() noexcept { return object_.release(); }

    static Result<Hierarchy> try_create(const Mesh &mesh, const Scheme &scheme,
                                        std::uint32_t levels, const Context *context = nullptr)
    {
        detail::Call call;
        carvel_hierarchy *out = nullptr;
        call.status = carvel_hierarchy_create(detail::raw(context), mesh.get(), scheme.get(),
                                              levels, &out, call.error());
        return call.result(Hierarchy(out));
    }

    std::uint32_t last_level() const noexcept { return carvel_hierarchy_last_level(get()); }

    Result<Counts> try_counts(std::uint32_t level) const
    {
        detail::Call call;
        Counts counts = detail::sized<Counts>();
        call.status = carvel_hierarchy_counts(get(), level, &counts, call.error());
        return call.result(counts);
    }

    /* The mesh of a level, shared and not copied. */
    Result<Mesh> try_mesh(std::uint32_t level) const
    {
        detail::Call call;
        carvel_mesh *out = nullptr;
        call.status = carvel_hierarchy_mesh(get(), level, &out, call.error());
        return call.result(Mesh(out));
    }

    /* Values on the control vertices to those on the vertices of a level, into
     * your buffer: what to call for each frame. Takes what values() takes, or
     * what values(), rows() and columns() give. */
    template <class V, class O>
    Result<void> try_refine_into(std::uint32_t level, const V &control, O &&out,
                                 const Context *context = nullptr) const
    {
        return try_interpolate_into(level, CARVEL_INTERPOLATION_VERTEX, control, out, context);
    }

    /* Into a vector. */
    template <class V>
    auto try_refine(std::uint32_t level, const V &control, const Context *context = nullptr) const
    {
        return try_interpolate(level, CARVEL_INTERPOLATION_VERTEX, control, context);
    }

    /* The same by rows of choice. */
    template <class V, class O>
    Result<void> try_interpolate_into(std::uint32_t level, carvel_interpolation interpolation,
                                      const V &control, O &&out,
                                      const Context *context = nullptr) const
    {
        const ConstValues from = values(control);
        const Values to = values(out);
        detail::Call call;
        call.status = detail::interpolate(get(), detail::raw(context), level, interpolation, &from,
                                          &to, call.error());
        return call.result();
    }
    template <class V>
    auto try_interpolate(std::uint32_t level, carvel_interpolation interpolation, const V &control,
                         const Context *context = nullptr) const
    {
        const ConstValues from = values(control);
        return interpolate_values(level, interpolation, from, context);
    }

    /* Where the vertices and the faces of a level, 1 to the last, come from. */
    Result<std::vector<Origin>> try_vertex_origins(std::uint32_t level) const
    {
        return origins(carvel_hierarchy_vertex_origins, &Counts::vertices, level);
    }
    Result<std::vector<Origin>> try_face_origins(std::uint32_t level) const
    {
        return origins(carvel_hierarchy_face_origins, &Counts::faces, level);
    }

    /* The weights of one stage of a step. Experimental. */
    Result<Rows> try_rows(std::uint32_t level, std::uint32_t stage) const
    {
        const Result<Counts> counts = try_counts(level);
        if (!counts)
            return counts.error();
        detail::Call call;
        Rows rows;
        std::uint64_t size = counts->vertices + 1;
        std::uint64_t count = 0;
        if (call.grow(rows.offsets, size))
            call.status = carvel_hierarchy_rows(get(), level, stage, rows.offsets.data(), size,
                                                nullptr, nullptr, 0, &count, call.error());
        if (call.status == CARVEL_STATUS_OK && !rows.offsets.empty() && count != 0 &&
            call.grow(rows.indices, count) && call.grow(rows.weights, count))
            call.status = carvel_hierarchy_rows(get(), level, stage, rows.offsets.data(), size,
                                                rows.indices.data(), rows.weights.data(), count,
                                                nullptr, call.error());
        return call.result(std::move(rows));
    }

#if CARVEL_HPP_THROWS
    static Hierarchy create(const Mesh &mesh, const Scheme &scheme, std::uint32_t levels,
                            const Context *context = nullptr)
    {
        return try_create(mesh, scheme, levels, context).value();
    }
    Counts counts(std::uint32_t level) const { return try_counts(level).value(); }
    Mesh mesh(std::uint32_t level) const { return try_mesh(level).value(); }
    template <class V, class O>
    void refine_into(std::uint32_t level, const V &control, O &&out,
                     const Context *context = nullptr) const
    {
        try_refine_into(level, control, out, context).value();
    }
    template <class V>
    auto refine(std::uint32_t level, const V &control, const Context *context = nullptr) const
    {
        return try_refine(level, control, context).value();
    }
    template <class V, class O>
    void interpolate_into(std::uint32_t level, carvel_interpolation interpolation,
                          const V &control, O &&out, const Context *context = nullptr) const
    {
        try_interpolate_into(level, interpolation, control, out, context).value();
    }
    template <class V>
    auto interpolate(std::uint32_t level, carvel_interpolation interpolation, const V &control,
                     const Context *context = nullptr) const
    {
        return try_interpolate(level, interpolation, control, context).value();
    }
    std::vector<Origin> vertex_origins(std::uint32_t level) const
    {
        return try_vertex_origins(level).value();
    }
    std::vector<Origin> face_origins(std::uint32_t level) const
    {
        return try_face_origins(level).value();
    }
    Rows rows(std::uint32_t level, std::uint32_t stage) const
    {
        return try_rows(level, stage).value();
    }
#endif

private:
    template <class T>
    Result<std::vector<T>> interpolate_values(std::uint32_t level,
                                              carvel_interpolation interpolation,
                                              const ConstValues<T> &from,
                                              const Context *context) const
    {
        const Result<Counts> counts = try_counts(level);
        if (!counts)
            return counts.error();
        detail::Call call;
        std::vector<T> out;
        /* What the library would refuse is refused before a vector is made. */
        const Values<T> nowhere(nullptr, 0, from.width);
        call.status = detail::interpolate(get(), detail::raw(context), level, interpolation, &from,
                                          &nowhere, call.error());
        if (call.status == CARVEL_STATUS_BUFFER_TOO_SMALL &&
            call.grow(out, counts->vertices, from.width)) {
            const Values<T> to(out.data(), counts->vertices, from.width);
            call.status = detail::interpolate(get(), detail::raw(context), level, interpolation,
                                              &from, &to, call.error());
        }
        return call.result(std::move(out));
    }

    template <class Getter>
    Result<std::vector<Origin>> origins(Getter getter, std::uint64_t Counts::*size,
                                        std::uint32_t level) const
    {
        const Result<Counts> counts = try_counts(level);
        if (!counts)
            return counts.error();
        detail::Call call;
        std::vector<Origin> out;
        if (call.grow(out, (*counts).*size))
            call.status = getter(get(), level, out.data(), (*counts).*size, call.error());
        return call.result(std::move(out));
    }
};

/* ==========================================================================
 * Stencils
 * ========================================================================== */

/* Which table: carvel_stencils_desc. */
struct StencilsDesc {
    std::uint32_t level = 1;
    std::uint32_t from_level = 0;
    carvel_precision precision = CARVEL_PRECISION_F32;
    carvel_interpolation interpolation = CARVEL_INTERPOLATION_VERTEX;
    /* The vertices that get a row; all if `selects` is false. */
    Span<const std::uint32_t> vertices = {};
    bool selects = false;
};

/* A sparse matrix in CSR form. */
template <class T>
struct Csr {
    std::vector<std::uint64_t> offsets;
    std::vector<std::uint32_t> indices;
    std::vector<T> weights;
};

/* Rows of weights: carvel_stencils. */
class Stencils : public detail::Handle<carvel_stencils, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_stencils *release() noexcept { return object_.release(); }

    static Result<Stencils> try_create(const Hierarchy &hierarchy, const StencilsDesc &desc,
                                       const Context *context = nullptr)
    {
        static const std::uint32_t none = 0;
        detail::Call call;
        carvel_stencils_desc c = detail::sized<carvel_stencils_desc>();
        c.from_level = desc.from_level;
        c.level = desc.level;
        c.interpolation = static_cast<std::int32_t>(desc.interpolation);
        c.precision = static_cast<std::int32_t>(desc.precision);
        if (desc.selects) {
            c.vertices = desc.vertices.size() == 0 ? &none : desc.vertices.data();
            c.vertex_count = desc.vertices.size();
        }
        carvel_stencils *out = nullptr;
        call.status = carvel_stencils_create(detail::raw(context), hierarchy.get(), &c, &out,
                                             call.error());
        return call.result(Stencils(out));
    }

    /* Where the vertices of a level go: rows of positions, of first and of second tangents. */
    static Result<Stencils> try_limits(const Hierarchy &hierarchy, std::uint32_t level,
                                       carvel_precision precision = CARVEL_PRECISION_F32,
                                       const Context *context = nullptr)
    {
        detail::Call call;
        carvel_stencils *out = nullptr;
        call.status = carvel_stencils_create_limits(detail::raw(context), hierarchy.get(), level,
                                                    static_cast<std::int32_t>(precision), &out,
                                                    call.error());
        return call.result(Stencils(out));
    }

    static Result<Stencils> try_load(const char *path)
    {
        detail::Call call;
        carvel_stencils *out = nullptr;
        call.status = carvel_stencils_load(path, &out, call.error());
        return call.result(Stencils(out));
    }
    Result<void> try_save(const char *path) const
    {
        detail::Call call;
        call.status = carvel_stencils_save(get(), path, call.error());
        return call.result();
    }

    /* The table that does what this and then another one do. */
    Result<Stencils> try_then(const Stencils &next, const Context *context = nullptr) const
    {
        detail::Call call;
        carvel_stencils *out = nullptr;
        call.status = carvel_stencils_product(detail::raw(context), get(), next.get(), &out,
                                              call.error());
        return call.result(Stencils(out));
    }
    Result<Stencils> try_transpose(const Context *context = nullptr) const
    {
        detail::Call call;
        carvel_stencils *out = nullptr;
        call.status =
            carvel_stencils_transpose(detail::raw(context), get(), &out, call.error());
        return call.result(Stencils(out));
    }

    Result<StencilCounts> try_counts() const
    {
        detail::Call call;
        StencilCounts counts = detail::sized<StencilCounts>();
        call.status = carvel_stencils_counts(get(), &counts, call.error());
        return call.result(counts);
    }

    /* The table as arrays, in float or double. */
    template <class T>
    Result<Csr<T>> try_csr() const
    {
        const Result<StencilCounts> counts = try_counts();
        if (!counts)
            return counts.error();
        detail::Call call;
        Csr<T> csr;
        if (call.grow(csr.offsets, counts->rows + 1) && call.grow(csr.indices, counts->entries) &&
            call.grow(csr.weights, counts->entries))
            call.status = detail::csr(get(), csr.offsets.data(), counts->rows + 1,
                                      csr.indices.data(), csr.weights.data(), counts->entries,
                                      call.error());
        return call.result(std::move(csr));
    }

    /* Values by the rows, into your buffer: replaced, added, or by the transpose.
     * Takes what values() takes, or what values(), rows() and columns() give. */
    template <class V, class O>
    Result<void> try_apply(const V &input, O &&out, const Context *context = nullptr) const
    {
        return run(detail::Verb::apply, input, out, context);
    }
    template <class V, class O>
    Result<void> try_apply_add(const V &input, O &&out, const Context *context = nullptr) const
    {
        return run(detail::Verb::add, input, out, context);
    }
    template <class V, class O>
    Result<void> try_apply_transpose(const V &input, O &&out,
                                     const Context *context = nullptr) const
    {
        return run(detail::Verb::transpose, input, out, context);
    }

    /* The rows that depend on some columns, again. */
    template <class V, class O>
    Result<void> try_update(Span<const std::uint32_t> changed, const V &input, O &&out,
                            const Context *context = nullptr) const
    {
        const ConstValues from = values(input);
        const Values to = values(out);
        detail::Call call;
        call.status = detail::update(get(), detail::raw(context), changed.data(), changed.size(),
                                     &from, &to, call.error());
        return call.result();
    }

#if CARVEL_HPP_THROWS
    static Stencils create(const Hierarchy &hierarchy, const StencilsDesc &desc,
                           const Context *context = nullptr)
    {
        return try_create(hierarchy, desc, context).value();
    }
    static Stencils limits(const Hierarchy &hierarchy, std::uint32_t level,
                           carvel_precision precision = CARVEL_PRECISION_F32,
                           const Context *context = nullptr)
    {
        return try_limits(hierarchy, level, precision, context).value();
    }
    static Stencils load(const char *path) { return try_load(path).value(); }
    void save(const char *path) const { try_save(path).value(); }
    Stencils then(const Stencils &next, const Context *context = nullptr) const
    {
        return try_then(next, context).value();
    }
    Stencils transpose(const Context *context = nullptr) const
    {
        return try_transpose(context).value();
    }
    StencilCounts counts() const { return try_counts().value(); }
    template <class T>
    Csr<T> csr() const
    {
        return try_csr<T>().value();
    }
    template <class V, class O>
    void apply(const V &input, O &&out, const Context *context = nullptr) const
    {
        try_apply(input, out, context).value();
    }
    template <class V, class O>
    void apply_add(const V &input, O &&out, const Context *context = nullptr) const
    {
        try_apply_add(input, out, context).value();
    }
    template <class V, class O>
    void apply_transpose(const V &input, O &&out, const Context *context = nullptr) const
    {
        try_apply_transpose(input, out, context).value();
    }
    template <class V, class O>
    void update(Span<const std::uint32_t> changed, const V &input, O &&out,
                const Context *context = nullptr) const
    {
        try_update(changed, input, out, context).value();
    }
#endif

private:
    template <class V, class O>
    Result<void> run(detail::Verb verb, const V &input, O &&out, const Context *context) const
    {
        const ConstValues from = values(input);
        const Values to = values(out);
        detail::Call call;
        call.status =
            detail::apply(verb, get(), detail::raw(context), &from, &to, call.error());
        return call.result();
    }
};

/* ==========================================================================
 * Surface: the limit surface at any point
 * ========================================================================== */

/* A face of the control mesh and coordinates in it: carvel_sample. */
using Sample = carvel_sample;

class Surface : public detail::Handle<carvel_surface, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_surface *release() noexcept { return object_.release(); }

    static Result<Surface> try_create(const Mesh &mesh, const Scheme &scheme,
                                      const Context *context = nullptr)
    {
        detail::Call call;
        carvel_surface *out = nullptr;
        call.status = carvel_surface_create(detail::raw(context), mesh.get(), scheme.get(), &out,
                                            call.error());
        return call.result(Surface(out));
    }

    /* The surface of values at corners. */
    static Result<Surface> try_create(const Channel &channel, const Scheme &scheme,
                                      const Context *context = nullptr)
    {
        detail::Call call;
        carvel_surface *out = nullptr;
        call.status = carvel_surface_create_channel(detail::raw(context), channel.get(),
                                                    scheme.get(), &out, call.error());
        return call.result(Surface(out));
    }

    /* 1, or one for each corner of a face. */
    Result<std::uint32_t> try_sectors(std::uint32_t face) const
    {
        detail::Call call;
        std::uint32_t sectors = 0;
        call.status = carvel_surface_sectors(get(), face, &sectors, call.error());
        return call.result(sectors);
    }

    /* Values on the control vertices to 1, 3 or 6 records for each sample, into your
     * buffer. Takes what values() takes, or what values(), rows() and columns() give. */
    template <class V, class O>
    Result<void> try_evaluate(Span<const Sample> samples, carvel_derivatives derivatives,
                              const V &control, O &&out, const Context *context = nullptr) const
    {
        const ConstValues from = values(control);
        const Values to = values(out);
        detail::Call call;
        call.status = detail::evaluate(get(), detail::raw(context), samples.data(),
                                       samples.size(), derivatives, &from, &to, call.error());
        return call.result();
    }

    /* The table that does the same. */
    Result<Stencils> try_stencils(Span<const Sample> samples, carvel_derivatives derivatives,
                                  carvel_precision precision = CARVEL_PRECISION_F32,
                                  const Context *context = nullptr) const
    {
        detail::Call call;
        carvel_stencils *out = nullptr;
        call.status = carvel_surface_stencils(detail::raw(context), get(), samples.data(),
                                              samples.size(),
                                              static_cast<std::int32_t>(derivatives),
                                              static_cast<std::int32_t>(precision), &out,
                                              call.error());
        return call.result(Stencils(out));
    }

#if CARVEL_HPP_THROWS
    static Surface create(const Mesh &mesh, const Scheme &scheme, const Context *context = nullptr)
    {
        return try_create(mesh, scheme, context).value();
    }
    static Surface create(const Channel &channel, const Scheme &scheme,
                          const Context *context = nullptr)
    {
        return try_create(channel, scheme, context).value();
    }
    std::uint32_t sectors(std::uint32_t face) const { return try_sectors(face).value(); }
    template <class V, class O>
    void evaluate(Span<const Sample> samples, carvel_derivatives derivatives, const V &control,
                  O &&out, const Context *context = nullptr) const
    {
        try_evaluate(samples, derivatives, control, out, context).value();
    }
    Stencils stencils(Span<const Sample> samples, carvel_derivatives derivatives,
                      carvel_precision precision = CARVEL_PRECISION_F32,
                      const Context *context = nullptr) const
    {
        return try_stencils(samples, derivatives, precision, context).value();
    }
#endif
};

/* ==========================================================================
 * Search: closest points and rays
 * ========================================================================== */

using Closest = carvel_closest;
using Ray = carvel_ray;
using Hit = carvel_hit;

/* True if there is such a point. */
inline bool found(const Closest &closest) noexcept { return closest.sample.face != UINT32_MAX; }
inline bool found(const Hit &hit) noexcept { return hit.sample.face != UINT32_MAX; }

/* carvel_search. */
class Search : public detail::Handle<carvel_search, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_search *release() noexcept { return object_.release(); }

    /* Takes what values() takes, or what values(), rows() and columns() give. */
    template <class V>
    static Result<Search> try_create(const Surface &surface, const V &control,
                                     const Context *context = nullptr)
    {
        const ConstValues from = values(control);
        detail::Call call;
        carvel_search *out = nullptr;
        call.status =
            detail::search(detail::raw(context), surface.get(), &from, &out, call.error());
        return call.result(Search(out));
    }

    /* The nearest point of the surface for each point. */
    Result<std::vector<Closest>> try_closest(Span<const std::array<double, 3>> points,
                                             double reach = HUGE_VAL,
                                             const Context *context = nullptr) const
    {
        detail::Call call;
        std::vector<Closest> out;
        const double *first = points.size() == 0 ? nullptr : points.data()->data();
        if (call.grow(out, points.size()))
            call.status = carvel_search_closest(get(), detail::raw(context), first, points.size(),
                                                reach, out.data(), call.error());
        return call.result(std::move(out));
    }

    /* The first point of the surface on each ray. */
    Result<std::vector<Hit>> try_intersect(Span<const Ray> rays,
                                           const Context *context = nullptr) const
    {
        detail::Call call;
        std::vector<Hit> out;
        if (call.grow(out, rays.size()))
            call.status = carvel_search_intersect(get(), detail::raw(context), rays.data(),
                                                  rays.size(), out.data(), call.error());
        return call.result(std::move(out));
    }

#if CARVEL_HPP_THROWS
    template <class V>
    static Search create(const Surface &surface, const V &control,
                         const Context *context = nullptr)
    {
        return try_create(surface, control, context).value();
    }
    std::vector<Closest> closest(Span<const std::array<double, 3>> points,
                                 double reach = HUGE_VAL, const Context *context = nullptr) const
    {
        return try_closest(points, reach, context).value();
    }
    std::vector<Hit> intersect(Span<const Ray> rays, const Context *context = nullptr) const
    {
        return try_intersect(rays, context).value();
    }
#endif
};

/* ==========================================================================
 * Tessellation: triangles on a limit surface
 * ========================================================================== */

using TriangleCounts = carvel_triangle_counts;

/* How fine: carvel_tessellation_desc. */
struct TessellationDesc {
    double tolerance = 0;
    carvel_fineness fineness = CARVEL_FINENESS_CHORD;
    std::uint32_t max_levels = 0;
    bool partial = false;
    std::uint64_t max_triangles = 0;
    /* For pixels: by rows. */
    std::array<double, 16> matrix = {};
    std::array<double, 2> viewport = {};
};

/* carvel_tessellation. */
class Tessellation : public detail::Handle<carvel_tessellation, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_tessellation *release() noexcept { return object_.release(); }

    /* Takes what values() takes, or what values(), rows() and columns() give. */
    template <class V>
    static Result<Tessellation> try_create(const Surface &surface, const V &control,
                                           const TessellationDesc &desc,
                                           const Context *context = nullptr)
    {
        const ConstValues from = values(control);
        carvel_tessellation_desc c = detail::sized<carvel_tessellation_desc>();
        c.fineness = static_cast<std::int32_t>(desc.fineness);
        c.tolerance = desc.tolerance;
        c.max_levels = desc.max_levels;
        c.partial = desc.partial;
        c.max_triangles = desc.max_triangles;
        std::copy(desc.matrix.begin(), desc.matrix.end(), c.matrix);
        std::copy(desc.viewport.begin(), desc.viewport.end(), c.viewport);
        detail::Call call;
        carvel_tessellation *out = nullptr;
        call.status = detail::tessellate(detail::raw(context), surface.get(), &from, &c, &out,
                                         call.error());
        return call.result(Tessellation(out));
    }

    Result<TriangleCounts> try_counts() const
    {
        detail::Call call;
        TriangleCounts counts = detail::sized<TriangleCounts>();
        call.status = carvel_tessellation_counts(get(), &counts, call.error());
        return call.result(counts);
    }

    /* Three vertices for each triangle. */
    Result<std::vector<std::uint32_t>> try_triangles() const
    {
        return triangles(3, [](const carvel_tessellation *of, std::uint32_t *out,
                               std::uint64_t count, carvel_error *error) {
            return carvel_tessellation_triangles(of, out, nullptr, nullptr, count, error);
        });
    }
    /* Three places for each triangle. */
    Result<std::vector<std::uint32_t>> try_triangle_places() const
    {
        return triangles(3, [](const carvel_tessellation *of, std::uint32_t *out,
                               std::uint64_t count, carvel_error *error) {
            return carvel_tessellation_triangles(of, nullptr, out, nullptr, count, error);
        });
    }
    /* The control face of each triangle. */
    Result<std::vector<std::uint32_t>> try_faces() const
    {
        return triangles(1, [](const carvel_tessellation *of, std::uint32_t *out,
                               std::uint64_t count, carvel_error *error) {
            return carvel_tessellation_triangles(of, nullptr, nullptr, out, count, error);
        });
    }
    Result<std::vector<Sample>> try_places() const
    {
        return places<Sample>([](const carvel_tessellation *of, Sample *out, std::uint64_t count,
                                 carvel_error *error) {
            return carvel_tessellation_places(of, out, nullptr, count, error);
        });
    }
    /* The vertex of each place. */
    Result<std::vector<std::uint32_t>> try_place_vertices() const
    {
        return places<std::uint32_t>([](const carvel_tessellation *of, std::uint32_t *out,
                                        std::uint64_t count, carvel_error *error) {
            return carvel_tessellation_places(of, nullptr, out, count, error);
        });
    }

    /* Three numbers for each vertex, or for each place, into your buffer. */
    template <class O>
    Result<void> try_positions(O &&out) const
    {
        const Values to = values(out);
        detail::Call call;
        call.status = detail::positions(get(), &to, call.error());
        return call.result();
    }
    template <class O>
    Result<void> try_normals(O &&out) const
    {
        const Values to = values(out);
        detail::Call call;
        call.status = detail::normals(get(), &to, call.error());
        return call.result();
    }

#if CARVEL_HPP_THROWS
    template <class V>
    static Tessellation create(const Surface &surface, const V &control,
                               const TessellationDesc &desc, const Context *context = nullptr)
    {
        return try_create(surface, control, desc, context).value();
    }
    TriangleCounts counts() const { return try_counts().value(); }
    std::vector<std::uint32_t> triangles() const { return try_triangles().value(); }
    std::vector<std::uint32_t> triangle_places() const { return try_triangle_places().value(); }
    std::vector<std::uint32_t> faces() const { return try_faces().value(); }
    std::vector<Sample> places() const { return try_places().value(); }
    std::vector<std::uint32_t> place_vertices() const { return try_place_vertices().value(); }
    template <class O>
    void positions(O &&out) const
    {
        try_positions(out).value();
    }
    template <class O>
    void normals(O &&out) const
    {
        try_normals(out).value();
    }
#endif

private:
    template <class T, class Get>
    Result<std::vector<T>> fill(std::uint64_t size, std::uint64_t capacity, Get get_list) const
    {
        detail::Call call;
        std::vector<T> out;
        if (call.grow(out, size))
            call.status = get_list(get(), out.data(), capacity, call.error());
        return call.result(std::move(out));
    }

    template <class Get>
    Result<std::vector<std::uint32_t>> triangles(std::uint64_t each, Get get_list) const
    {
        const Result<TriangleCounts> counts = try_counts();
        if (!counts)
            return counts.error();
        return fill<std::uint32_t>(each * counts->triangles, counts->triangles, get_list);
    }

    template <class T, class Get>
    Result<std::vector<T>> places(Get get_list) const
    {
        const Result<TriangleCounts> counts = try_counts();
        if (!counts)
            return counts.error();
        return fill<T>(counts->places, counts->places, get_list);
    }
};

/* ==========================================================================
 * Mask: a scheme of polygons, and what is proved of it
 * ========================================================================== */

/* Values at (first + i) / arity^levels; outside of them the function is 0. */
struct LimitSamples {
    std::int64_t first = 0;
    std::vector<double> values;
};

class Mask : public detail::Handle<carvel_mask, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_mask *release() noexcept { return object_.release(); }

    /* A name of the catalogue, or coefficients of an arity. */
    static Result<Mask> try_create(const char *text, std::uint32_t arity = 0)
    {
        detail::Call call;
        carvel_mask *out = nullptr;
        call.status = carvel_mask_create(text, arity, &out, call.error());
        return call.result(Mask(out));
    }

    /* Coefficients with the index of the first. */
    static Result<Mask> try_create_with_offset(const char *text, std::uint32_t arity,
                                               std::int64_t offset)
    {
        detail::Call call;
        carvel_mask *out = nullptr;
        call.status = carvel_mask_create_with_offset(text, arity, offset, &out, call.error());
        return call.result(Mask(out));
    }

    Result<std::vector<Fraction>> try_coefficients() const
    {
        detail::Call call;
        std::vector<Fraction> out;
        std::uint64_t count = 0;
        call.status = carvel_mask_coefficients(get(), nullptr, 0, &count, call.error());
        if (call.status == CARVEL_STATUS_OK && call.grow(out, count))
            call.status =
                carvel_mask_coefficients(get(), out.data(), count, nullptr, call.error());
        return call.result(std::move(out));
    }

    /* The scheme on meshes whose regular rule is the mask's tensor square. */
    Result<Scheme> try_scheme() const
    {
        detail::Call call;
        carvel_scheme *out = nullptr;
        call.status = carvel_mask_scheme(get(), &out, call.error());
        return call.result(Scheme(out));
    }

    Result<MaskAnalysis> try_analyse(const Context *context = nullptr) const
    {
        detail::Call call;
        MaskAnalysis analysis = detail::sized<MaskAnalysis>();
        call.status = carvel_mask_analyse(get(), detail::raw(context), &analysis, call.error());
        return call.result(analysis);
    }

    /* The limit function, or a derivative, at multiples of arity^-levels. */
    Result<LimitSamples> try_sample_limit(std::uint32_t levels, std::uint32_t derivative = 0,
                                          const Context *context = nullptr) const
    {
        detail::Call call;
        LimitSamples out;
        std::uint64_t count = 0;
        const auto sample = [&](double *values, std::uint64_t capacity) {
            return carvel_mask_sample_limit(get(), detail::raw(context), derivative, levels,
                                            &out.first, values, capacity, &count, call.error());
        };
        call.status = sample(nullptr, 0);
        if (call.status == CARVEL_STATUS_OK && call.grow(out.values, count))
            call.status = sample(out.values.data(), count);
        return call.result(std::move(out));
    }

    /* Points and ends after some steps. */
    Result<PolygonCounts> try_counts(carvel_ends ends, std::uint64_t points,
                                     std::uint32_t steps) const
    {
        detail::Call call;
        PolygonCounts counts = detail::sized<PolygonCounts>();
        call.status = carvel_mask_counts(get(), static_cast<std::int32_t>(ends), points, steps,
                                         &counts, call.error());
        return call.result(counts);
    }

    /* Points and ends of the limit, or of a derivative. */
    Result<PolygonCounts> try_limit_counts(carvel_ends ends, std::uint64_t points,
                                           std::uint32_t derivative = 0) const
    {
        detail::Call call;
        PolygonCounts counts = detail::sized<PolygonCounts>();
        call.status = carvel_mask_limit_counts(get(), static_cast<std::int32_t>(ends), points,
                                               derivative, &counts, call.error());
        return call.result(counts);
    }

    /* A refined polygon, into your buffer or as a vector. Takes what values() takes, or
     * what values(), rows() and columns() give. */
    template <class V, class O>
    Result<void> try_refine_into(carvel_ends ends, std::uint32_t steps, const V &points, O &&out,
                                 const Context *context = nullptr) const
    {
        const ConstValues from = values(points);
        const Values to = values(out);
        detail::Call call;
        call.status =
            detail::refine(get(), detail::raw(context), ends, steps, &from, &to, call.error());
        return call.result();
    }
    template <class V>
    auto try_refine(carvel_ends ends, std::uint32_t steps, const V &points,
                    const Context *context = nullptr) const
    {
        const ConstValues from = values(points);
        const auto work = [&](const auto *to, carvel_error *error) {
            return detail::refine(get(), detail::raw(context), ends, steps, &from, to, error);
        };
        return made(try_counts(ends, from.count, steps), from, work);
    }

    /* Points of the limit that belong to those of a polygon, or derivatives. */
    template <class V, class O>
    Result<void> try_limit_into(carvel_ends ends, std::uint32_t derivative, const V &points,
                                O &&out, const Context *context = nullptr) const
    {
        const ConstValues from = values(points);
        const Values to = values(out);
        detail::Call call;
        call.status = detail::limit(get(), detail::raw(context), ends, derivative, &from, &to,
                                    call.error());
        return call.result();
    }
    template <class V>
    auto try_limit(carvel_ends ends, std::uint32_t derivative, const V &points,
                   const Context *context = nullptr) const
    {
        const ConstValues from = values(points);
        const auto work = [&](const auto *to, carvel_error *error) {
            return detail::limit(get(), detail::raw(context), ends, derivative, &from, to, error);
        };
        return made(try_limit_counts(ends, from.count, derivative), from, work);
    }

    /* A grid, row by row, refined by this mask from row to row and `along` the rows. */
    template <class V, class O>
    Result<void> try_refine_grid_into(const Mask &along, carvel_ends ends_down,
                                      carvel_ends ends_along, std::uint64_t columns,
                                      std::uint32_t steps, const V &points, O &&out,
                                      const Context *context = nullptr) const
    {
        const ConstValues from = values(points);
        const Values to = values(out);
        detail::Call call;
        call.status = detail::refine_grid(get(), along.get(), detail::raw(context), ends_down,
                                          ends_along, columns, steps, &from, &to, call.error());
        return call.result();
    }

#if CARVEL_HPP_THROWS
    static Mask create(const char *text, std::uint32_t arity = 0)
    {
        return try_create(text, arity).value();
    }
    static Mask create_with_offset(const char *text, std::uint32_t arity, std::int64_t offset)
    {
        return try_create_with_offset(text, arity, offset).value();
    }
    std::vector<Fraction> coefficients() const { return try_coefficients().value(); }
    LimitSamples sample_limit(std::uint32_t levels, std::uint32_t derivative = 0,
                              const Context *context = nullptr) const
    {
        return try_sample_limit(levels, derivative, context).value();
    }
    Scheme scheme() const { return try_scheme().value(); }
    MaskAnalysis analyse(const Context *context = nullptr) const
    {
        return try_analyse(context).value();
    }
    PolygonCounts counts(carvel_ends ends, std::uint64_t points, std::uint32_t steps) const
    {
        return try_counts(ends, points, steps).value();
    }
    template <class V, class O>
    void refine_into(carvel_ends ends, std::uint32_t steps, const V &points, O &&out,
                     const Context *context = nullptr) const
    {
        try_refine_into(ends, steps, points, out, context).value();
    }
    template <class V>
    auto refine(carvel_ends ends, std::uint32_t steps, const V &points,
                const Context *context = nullptr) const
    {
        return try_refine(ends, steps, points, context).value();
    }
    PolygonCounts limit_counts(carvel_ends ends, std::uint64_t points,
                               std::uint32_t derivative = 0) const
    {
        return try_limit_counts(ends, points, derivative).value();
    }
    template <class V, class O>
    void limit_into(carvel_ends ends, std::uint32_t derivative, const V &points, O &&out,
                    const Context *context = nullptr) const
    {
        try_limit_into(ends, derivative, points, out, context).value();
    }
    template <class V>
    auto limit(carvel_ends ends, std::uint32_t derivative, const V &points,
               const Context *context = nullptr) const
    {
        return try_limit(ends, derivative, points, context).value();
    }
    template <class V, class O>
    void refine_grid_into(const Mask &along, carvel_ends ends_down, carvel_ends ends_along,
                          std::uint64_t columns, std::uint32_t steps, const V &points, O &&out,
                          const Context *context = nullptr) const
    {
        try_refine_grid_into(along, ends_down, ends_along, columns, steps, points, out, context)
            .value();
    }
#endif

private:
    /* A vector for as many points, after asking what the library would refuse. */
    template <class T, class Work>
    static Result<std::vector<T>> made(const Result<PolygonCounts> &counts,
                                       const ConstValues<T> &from, const Work &work)
    {
        if (!counts)
            return counts.error();
        detail::Call call;
        std::vector<T> out;
        const Values<T> nowhere(nullptr, 0, from.width);
        call.status = work(&nowhere, call.error());
        if (call.status == CARVEL_STATUS_BUFFER_TOO_SMALL &&
            call.grow(out, counts->points, from.width)) {
            const Values<T> to(out.data(), counts->points, from.width);
            call.status = work(&to, call.error());
        }
        return call.result(std::move(out));
    }
};

/* ==========================================================================
 * GridMask: a scheme of grids, by any mask of two directions
 * ========================================================================== */

/* Rows and columns of a grid. */
struct GridSize {
    std::uint64_t rows = 0;
    std::uint64_t columns = 0;
};

class GridMask : public detail::Handle<carvel_grid_mask, detail::destroy> {
public:
    using Handle::Handle;
    /* Hands the object over to the caller. */
    carvel_grid_mask *release() noexcept { return object_.release(); }

    /* Coefficients row by row; arities and offsets from row to row, and along. */
    static Result<GridMask> try_create(const std::vector<Fraction> &coefficients,
                                       std::uint64_t columns, std::array<std::uint32_t, 2> arity,
                                       std::array<std::int64_t, 2> offset)
    {
        detail::Call call;
        carvel_grid_mask *out = nullptr;
        call.status =
            carvel_grid_mask_create(coefficients.data(), coefficients.size(), columns, arity[0],
                                    arity[1], offset[0], offset[1], &out, call.error());
        return call.result(GridMask(out));
    }

    /* The size of a grid after some steps. */
    Result<GridSize> try_counts(carvel_ends ends_down, carvel_ends ends_along, GridSize size,
                                std::uint32_t steps) const
    {
        detail::Call call;
        GridSize out;
        call.status = carvel_grid_mask_counts(
            get(), static_cast<std::int32_t>(ends_down), static_cast<std::int32_t>(ends_along),
            size.rows, size.columns, steps, &out.rows, &out.columns, call.error());
        return call.result(out);
    }

    /* A grid, row by row, after some steps. */
    template <class V, class O>
    Result<void> try_refine_into(carvel_ends ends_down, carvel_ends ends_along,
                                 std::uint64_t columns, std::uint32_t steps, const V &points,
                                 O &&out, const Context *context = nullptr) const
    {
        const ConstValues from = values(points);
        const Values to = values(out);
        detail::Call call;
        call.status = detail::refine_grid(get(), detail::raw(context), ends_down, ends_along,
                                          columns, steps, &from, &to, call.error());
        return call.result();
    }

#if CARVEL_HPP_THROWS
    static GridMask create(const std::vector<Fraction> &coefficients, std::uint64_t columns,
                           std::array<std::uint32_t, 2> arity, std::array<std::int64_t, 2> offset)
    {
        return try_create(coefficients, columns, arity, offset).value();
    }
    GridSize counts(carvel_ends ends_down, carvel_ends ends_along, GridSize size,
                    std::uint32_t steps) const
    {
        return try_counts(ends_down, ends_along, size, steps).value();
    }
    template <class V, class O>
    void refine_into(carvel_ends ends_down, carvel_ends ends_along, std::uint64_t columns,
                     std::uint32_t steps, const V &points, O &&out,
                     const Context *context = nullptr) const
    {
        try_refine_into(ends_down, ends_along, columns, steps, points, out, context).value();
    }
#endif
};

/* ==========================================================================
 * catalogue: the schemes of polygons that have names
 *
 * Texts stay as long as the library is loaded.
 * ========================================================================== */

/* A parameter of a family: see carvel_catalogue_parameter. */
struct CatalogueParameter {
    const char *name;
    const char *range;
    const char *default_value;
    bool is_free;
};

/* A scheme by name: see carvel_catalogue_entry. */
struct CatalogueEntry {
    const char *name;
    const char *summary;
    const char *authors;
    const char *year;
    const char *formula;
    const char *attribution;
    /* Empty if it is stationary. */
    const char *limit;
    bool is_stationary;
    std::vector<CatalogueParameter> parameters;
};

/* The scheme of an index below carvel_catalogue_count(). */
inline Result<CatalogueEntry> try_catalogue_entry(std::uint64_t index)
{
    detail::Call call;
    auto entry = detail::sized<carvel_catalogue_entry>();
    call.status = carvel_catalogue_entry_at(index, &entry, call.error());
    CatalogueEntry out = {entry.name,    entry.summary,     entry.authors, entry.year,
                          entry.formula, entry.attribution, entry.limit,   entry.is_stationary != 0,
                          {}};
    if (call.status == CARVEL_STATUS_OK && call.grow(out.parameters, entry.parameter_count)) {
        auto parameter = detail::sized<carvel_catalogue_parameter>();
        for (std::uint64_t i = 0; i < entry.parameter_count && call.status == CARVEL_STATUS_OK;
             ++i) {
            call.status = carvel_catalogue_parameter_at(index, i, &parameter, call.error());
            out.parameters[i] = {parameter.name, parameter.range, parameter.default_value,
                                 parameter.is_free != 0};
        }
    }
    return call.result(std::move(out));
}

/* For which values of a parameter the schemes of a family are C^`continuity`. */
inline Result<std::vector<ParameterRange>>
try_catalogue_ranges(const char *name, const char *parameter, std::uint32_t continuity,
                     Fraction low, Fraction high, Fraction tolerance,
                     const Context *context = nullptr)
{
    /* More than families have, so that the search is not made twice. */
    constexpr std::uint64_t most = 32;
    detail::Call call;
    std::vector<ParameterRange> out;
    std::uint64_t count = 0;
    const auto search = [&] {
        return carvel_catalogue_ranges(name, parameter, detail::raw(context), continuity, low,
                                       high, tolerance, out.data(), out.size(), &count,
                                       call.error());
    };
    if (call.grow(out, most))
        call.status = search();
    if (call.status == CARVEL_STATUS_BUFFER_TOO_SMALL && call.grow(out, count))
        call.status = search();
    if (call.status == CARVEL_STATUS_OK)
        out.resize(static_cast<std::size_t>(count));
    return call.result(std::move(out));
}

#if CARVEL_HPP_THROWS
inline CatalogueEntry catalogue_entry(std::uint64_t index)
{
    return try_catalogue_entry(index).value();
}
inline std::vector<ParameterRange> catalogue_ranges(const char *name, const char *parameter,
                                                    std::uint32_t continuity, Fraction low,
                                                    Fraction high, Fraction tolerance,
                                                    const Context *context = nullptr)
{
    return try_catalogue_ranges(name, parameter, continuity, low, high, tolerance, context)
        .value();
}
#endif

/* ==========================================================================
 * openmesh: meshes of OpenMesh
 *
 * Templates on the mesh type, which must be a TriMesh_ArrayKernelT or
 * PolyMesh_ArrayKernelT of any traits, or like one; include OpenMesh yourself.
 * Vertices and faces keep the order of their handles. Points are read in place.
 * Texture coordinates on vertices are carried; those on halfedges (seams), other
 * properties and normals are not.
 * ========================================================================== */

namespace openmesh {

/* The number type of a mesh's points. */
template <class M>
using Scalar = std::decay_t<decltype(std::declval<const M &>().points()[0][0])>;

/* The points of a mesh, read in place: valid until it changes. */
template <class M>
ConstValues<Scalar<M>> positions(const M &mesh)
{
    using Point = std::decay_t<decltype(mesh.points()[0])>;
    static_assert(sizeof(Point) >= 3 * sizeof(Scalar<M>), "carvel: points have 3 coordinates");
    if (mesh.n_vertices() == 0)
        return {nullptr, 0};
    return {&mesh.points()[0][0], mesh.n_vertices(), 3, sizeof(Point)};
}

/* Reads the faces of a mesh. One with deleted elements is refused as
 * CARVEL_STATUS_UNSUPPORTED, naming the first: call garbage_collection(). */
template <class M>
Result<Mesh> try_read(const M &mesh, const MeshOptions &options = {},
                      const Context *context = nullptr)
{
    const auto deleted = [](carvel_element_kind kind, int index) {
        const bool face = kind == CARVEL_ELEMENT_FACE;
        return Failure(CARVEL_STATUS_UNSUPPORTED,
                       std::string(face ? "face " : "vertex ") + std::to_string(index) +
                           " of the OpenMesh mesh is deleted: call garbage_collection() first",
                       {Element{static_cast<std::uint64_t>(kind),
                                static_cast<std::uint64_t>(index), 0}});
    };
    if (mesh.has_vertex_status())
        for (const auto vertex : mesh.all_vertices())
            if (mesh.status(vertex).deleted())
                return deleted(CARVEL_ELEMENT_VERTEX, vertex.idx());
    std::vector<std::uint32_t> sizes;
    std::vector<std::uint32_t> corners;
    detail::Call call;
    if (!call.grow(sizes, mesh.n_faces()) || !call.grow(corners, mesh.n_halfedges()))
        return call.result(Mesh());
    sizes.clear();
    corners.clear();
    for (const auto face : mesh.all_faces()) {
        if (mesh.has_face_status() && mesh.status(face).deleted())
            return deleted(CARVEL_ELEMENT_FACE, face.idx());
        const std::size_t first = corners.size();
        for (auto vertex = mesh.cfv_begin(face); vertex.is_valid(); ++vertex)
            corners.push_back(static_cast<std::uint32_t>(vertex->idx()));
        sizes.push_back(static_cast<std::uint32_t>(corners.size() - first));
    }
    return Mesh::try_create({mesh.n_vertices(), sizes, corners}, options, context);
}

/* The texture coordinates on the vertices of a mesh, as numbers of its points'
 * type: 2 for each vertex, or none if the mesh has none. */
template <class M>
std::vector<Scalar<M>> texcoords(const M &mesh)
{
    std::vector<Scalar<M>> uv;
    if (!mesh.has_vertex_texcoords2D())
        return uv;
    uv.reserve(2 * mesh.n_vertices());
    for (const auto vertex : mesh.all_vertices())
        for (const unsigned axis : {0U, 1U})
            uv.push_back(static_cast<Scalar<M>>(mesh.texcoord2D(vertex)[axis]));
    return uv;
}

/* Clears a polygon mesh and writes faces, xyz and, if not empty, uv into it. A
 * face that OpenMesh does not take, which one of a refined mesh can hardly be,
 * ends the work and is named; CARVEL_STATUS_UNSUPPORTED. */
template <class T, class M>
Result<void> try_write(const Refined<T> &refined, M &mesh, Span<const T> uv = {})
{
    static_assert(!M::is_trimesh(), "carvel: refined faces have four corners and more: write to "
                                    "a PolyMesh_ArrayKernelT, triangulate() it if you must");
    using Point = typename M::Point;
    using Texture = typename M::TexCoord2D;
    using To = std::decay_t<decltype(std::declval<Point &>()[0])>;
    using ToTexture = std::decay_t<decltype(std::declval<Texture &>()[0])>;
    if (!uv.empty() && uv.size() != 2 * refined.vertex_count())
        return Failure(CARVEL_STATUS_LENGTH_MISMATCH,
                       std::to_string(uv.size()) + " texture values for " +
                           std::to_string(refined.vertex_count()) + " vertices");
    mesh.clear();
    mesh.reserve(refined.vertex_count(), refined.face_vertices.size(), refined.face_count());
    if (!uv.empty() && !mesh.has_vertex_texcoords2D())
        mesh.request_vertex_texcoords2D();
    for (std::size_t i = 0; i < refined.vertex_count(); ++i) {
        const T *const xyz = &refined.positions[3 * i];
        const auto vertex = mesh.add_vertex(Point(
            static_cast<To>(xyz[0]), static_cast<To>(xyz[1]), static_cast<To>(xyz[2])));
        if (!uv.empty())
            mesh.set_texcoord2D(vertex, Texture(static_cast<ToTexture>(uv[2 * i]),
                                                static_cast<ToTexture>(uv[2 * i + 1])));
    }
    std::vector<typename M::VertexHandle> corners;
    const std::uint32_t *next = refined.face_vertices.data();
    for (std::size_t i = 0; i < refined.face_count(); ++i) {
        corners.clear();
        for (std::uint32_t j = 0; j < refined.face_sizes[i]; ++j)
            corners.emplace_back(static_cast<int>(*next++));
        if (!mesh.add_face(corners).is_valid())
            return Failure(CARVEL_STATUS_UNSUPPORTED,
                           "OpenMesh does not take face " + std::to_string(i),
                           {Element{CARVEL_ELEMENT_FACE, i, 0}});
    }
    return {};
}

/* Refines one mesh into another, which may be the same. What is there of the
 * other is lost, but not before everything else has succeeded. */
template <class In, class Out>
Result<void> try_refine(const In &in, const Scheme &scheme, std::uint32_t levels, Out &out,
                        const Context *context = nullptr)
{
    using T = Scalar<In>;
    const Result<Mesh> mesh = try_read(in, {}, context);
    if (!mesh)
        return mesh.error();
    const std::vector<T> uv = texcoords(in);
    const ConstValues<T> texture = values(uv, 2);
    RefineInput<T> input{*mesh, scheme, levels, positions(in)};
    if (!uv.empty())
        input.attributes = {&texture, 1};
    const Result<Refined<T>> refined = carvel::try_refine(input, context);
    if (!refined)
        return refined.error();
    if (uv.empty())
        return try_write(*refined, out);
    return try_write(*refined, out, Span<const T>(refined->attributes[0]));
}

#if CARVEL_HPP_THROWS
template <class M>
Mesh read(const M &mesh, const MeshOptions &options = {}, const Context *context = nullptr)
{
    return try_read(mesh, options, context).value();
}

template <class T, class M>
void write(const Refined<T> &refined, M &mesh, Span<const T> uv = {})
{
    try_write(refined, mesh, uv).value();
}

template <class In, class Out>
void refine(const In &in, const Scheme &scheme, std::uint32_t levels, Out &out,
            const Context *context = nullptr)
{
    try_refine(in, scheme, levels, out, context).value();
}
#endif

} // namespace openmesh
} // namespace CARVEL_HPP_STYLE
} // namespace carvel

#undef CARVEL_HPP_STYLE
#undef CARVEL_HPP_THROWS

#endif /* CARVEL_HPP */
