; 2 dm are there; 6 are wanted in the tank after 14 were delivered, and no more than 15 fit.
(define (problem morning)
  (:domain tank)
  (:objects t1 - tank q2 q4 q6 q8 - quantity)
  (:init
    (= (level t1) 2) (= (highest t1) 15) (= (delivered t1) 0) (= (effort) 0)
    (= (amount q2) 2) (= (amount q4) 4) (= (amount q6) 6) (= (amount q8) 8))
  (:goal (and (= (level t1) 6) (= (delivered t1) 14)))
  (:metric minimize (effort)))
