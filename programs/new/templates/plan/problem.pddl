; The state at the start, and what is wanted. The page sets other goals while the cell runs.
(define (problem morning)
  (:domain batch)
  (:objects v1 - vessel a20 a30 - amount)
  (:init
    (= (level v1) 2) (= (heel v1) 2) (= (capacity v1) 45)
    (= (temperature v1) 20) (= (cold) 20) (= (lukewarm) 30) (= (hot) 60)
    (= (litres a20) 20) (= (litres a30) 30)
    (= (product) 0) (= (batches) 0))
  (:goal (= (product) 50))
  (:metric minimize (batches)))
