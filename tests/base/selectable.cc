// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The named run-time choice: an entry `Type` and a subsection per candidate,
// those that programs add included. Expected values are what the texts say.

#include <corotet/base/selectable.h>

#include <gtest/gtest.h>

using namespace corotet;

namespace
{
  class Shape
  {
  public:
    virtual ~Shape() = default;

    virtual void
    declare_parameters(dealii::ParameterHandler &prm) = 0;

    virtual double
    area() const = 0;
  };

  class Square : public Shape
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.add_parameter("Side", side);
    }

    double
    area() const override
    {
      return side * side;
    }

    double side = 2;
  };

  class Nothing : public Shape
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &) override
    {}

    double
    area() const override
    {
      return 0;
    }
  };

  // A shape with a given area.
  class Blob : public Shape
  {
  public:
    explicit Blob(const double size)
      : size(size)
    {}

    void
    declare_parameters(dealii::ParameterHandler &) override
    {}

    double
    area() const override
    {
      return size;
    }

  private:
    double size;
  };

  std::vector<Candidate<Shape>>
  shapes()
  {
    return with_added<Shape>({candidate<Shape, Square>("square"),
                              candidate<Shape, Nothing>("nothing")});
  }
} // namespace

TEST(Selectable, HasItsDefaults)
{
  Selectable<Shape>        shape(shapes(), "square");
  dealii::ParameterHandler prm;
  shape.declare_parameters(prm, "Which shape.");
  EXPECT_EQ(shape.name(), "square");
  EXPECT_EQ(shape.selected().area(), 4);
}

TEST(Selectable, ReadsTypeAndParametersOfCandidates)
{
  Selectable<Shape>        shape(shapes(), "nothing");
  dealii::ParameterHandler prm;
  shape.declare_parameters(prm, "Which shape.");
  EXPECT_EQ(shape.selected().area(), 0);
  prm.parse_input_from_string("set Type = square\n"
                              "subsection square\n"
                              "  set Side = 3\n"
                              "end\n"
                              "subsection nothing\n"
                              "end\n");
  EXPECT_EQ(shape.name(), "square");
  EXPECT_EQ(shape.selected().area(), 9);
}

// An object that is made has the parameters that were read, and is independent
// of them: changing it changes no other one.
TEST(Selectable, MakesObjectsApart)
{
  Selectable<Shape>        shape(shapes(), "square");
  dealii::ParameterHandler prm;
  shape.declare_parameters(prm, "Which shape.");
  prm.parse_input_from_string("subsection square\n set Side = 3\nend\n");
  const std::unique_ptr<Shape> first  = shape.make();
  const std::unique_ptr<Shape> second = shape.make();
  EXPECT_EQ(first->area(), 9);
  prm.parse_input_from_string("subsection square\n set Side = 5\nend\n");
  EXPECT_EQ(shape.make()->area(), 25);
  EXPECT_EQ(first->area(), 9);
  dynamic_cast<Square &>(*first).side = 1;
  EXPECT_EQ(second->area(), 9);
  EXPECT_EQ(shape.selected().area(), 25);
}

TEST(Selectable, RefusesUnknownNames)
{
  Selectable<Shape>        shape(shapes(), "square");
  dealii::ParameterHandler prm;
  shape.declare_parameters(prm, "Which shape.");
  EXPECT_THROW(prm.set("Type", "circle"),
               dealii::ParameterHandler::ExcValueDoesNotMatchPattern);
}

TEST(Selectable, NamesThoseWithAProperty)
{
  const Selectable<Shape> shape(shapes(), "square");
  EXPECT_EQ(shape.names_of([](const Shape &s) { return s.area() > 0; }),
            "square");
  EXPECT_EQ(shape.names_of([](const Shape &s) { return s.area() < 9; }),
            "square, nothing");
  EXPECT_EQ(shape.names_of([](const Shape &s) { return s.area() > 9; }), "");
}

// Candidates that a program adds can be selected like the others, and are
// listed after them, as long as their AddedCandidate lives; a Selectable that
// was made in that time keeps them.
TEST(Selectable, HasAddedCandidates)
{
  std::unique_ptr<Selectable<Shape>> shape;
  dealii::ParameterHandler           prm;
  {
    const AddedCandidate<Shape> blob(candidate<Shape, Blob>("blob", 7.));
    shape = std::make_unique<Selectable<Shape>>(shapes(), "square");
    EXPECT_EQ(shapes().size(), 3u);
    EXPECT_EQ(shapes().back().name, "blob");
  }
  EXPECT_EQ(shapes().size(), 2u);
  shape->declare_parameters(prm, "Which shape.");
  EXPECT_EQ(shape->selected().area(), 4);
  prm.parse_input_from_string("set Type = blob\nsubsection blob\nend\n");
  EXPECT_EQ(shape->selected().area(), 7);
}

TEST(Selectable, RefusesAddedCandidatesWithTheSameName)
{
  {
    const AddedCandidate<Shape> square(candidate<Shape, Blob>("square", 1.));
    EXPECT_THROW(shapes(), std::logic_error);
  }
  // The first candidate stays. A name must be a single choice, without "/", "|"
  // and blanks at its ends.
  const AddedCandidate<Shape> blob(candidate<Shape, Blob>("blob", 1.));
  for (const std::string name : {"blob", "", "a|b", "a/b", " a", "a "})
    EXPECT_THROW(const AddedCandidate<Shape> another(
                   candidate<Shape, Blob>(name, 2.)),
                 std::logic_error)
      << name;
  ASSERT_EQ(shapes().size(), 3u);
  EXPECT_EQ(shapes().back().make()->area(), 1);
}
