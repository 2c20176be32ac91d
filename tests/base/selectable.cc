// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The named run-time choice: an entry `Type` and a subsection per candidate.
// Expected values are what the parameter texts say.

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

  private:
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

  std::vector<Candidate<Shape>>
  shapes()
  {
    return {candidate<Shape, Square>("square"),
            candidate<Shape, Nothing>("nothing")};
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

TEST(Selectable, RefusesUnknownNames)
{
  Selectable<Shape>        shape(shapes(), "square");
  dealii::ParameterHandler prm;
  shape.declare_parameters(prm, "Which shape.");
  EXPECT_THROW(prm.set("Type", "circle"),
               dealii::ParameterHandler::ExcValueDoesNotMatchPattern);
}
