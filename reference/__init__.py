"""What hand-written code is judged against: scenarios, engines, measurements, theory and the comparison."""
